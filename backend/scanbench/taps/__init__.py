"""Readers of the image: they look in the seam, and never write."""
