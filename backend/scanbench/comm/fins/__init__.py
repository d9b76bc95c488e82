"""FINS, which Omron's tools and many others speak: over UDP and over TCP."""
