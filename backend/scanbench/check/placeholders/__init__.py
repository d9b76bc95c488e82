"""Texts for libraries that a project refers to and nobody has: what their use says of what they declare."""
