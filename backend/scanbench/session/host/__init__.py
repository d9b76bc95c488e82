"""The process of one virtual PLC: `python -m scanbench.session.host FD`."""
