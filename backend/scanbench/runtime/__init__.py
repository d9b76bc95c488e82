"""The virtual PLC: image, seam, journal, scan loop."""
