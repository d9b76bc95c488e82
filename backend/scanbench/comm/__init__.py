"""The virtual communication unit: protocols that tools, HMIs and SCADA speak to a PLC."""
