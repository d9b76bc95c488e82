"""What a client may choose in `initializationOptions`."""

STATEMENTS = "statements"
"""True for symbols of documents with the statements that have others inside of them."""
