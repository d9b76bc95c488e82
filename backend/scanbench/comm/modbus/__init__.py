"""Modbus TCP, which nearly every HMI and SCADA speaks."""
