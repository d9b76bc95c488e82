"""Libraries of vendors as texts: their declarations from public documentation, with real bodies where no device is needed."""
