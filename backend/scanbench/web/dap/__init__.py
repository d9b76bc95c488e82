"""The Debug Adapter: DAP of every client on one side, a session of one PLC on the other."""
