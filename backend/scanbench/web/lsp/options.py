"""What a client may choose in `initializationOptions`."""

STATEMENTS = "statements"
"""True for symbols of documents with the statements that have others inside of them."""
CHECKS = "embeddedChecks"
"""True for inlay hints where the compiler embedded a check of a subrange, or proved that none is needed."""
LISTS = "lists"
"""True where the client has the commands that list the instances and references counted above a declaration."""
