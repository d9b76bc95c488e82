"""Scanbench: a bench for debugging PLC programs (IEC 61131-3) on virtual PLCs of real models."""

__version__ = "0.1.0"
