"""The process of one virtual PLC."""
