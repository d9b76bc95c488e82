"""PLC models: memory areas, addresses and error catalogues, read from model files."""
