"""Controllers that run elsewhere, read as the control device of a verification."""
