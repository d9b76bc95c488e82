"""SLMP (MC protocol, 3E frames), which tools and HMIs speak to a MELSEC: in binary and in ASCII code."""
