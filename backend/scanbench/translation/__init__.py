"""What people read, in their language; see README.md."""
