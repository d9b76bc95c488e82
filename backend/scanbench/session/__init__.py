"""The one door: sessions of people with virtual PLCs, each in a process of its own."""
