"""OPC UA, which SCADA and HMIs of today speak: asyncua has the protocol, this room what it serves."""
