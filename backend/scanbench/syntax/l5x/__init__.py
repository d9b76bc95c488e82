"""Files of Rockwell's Studio 5000 (L5X) -> the files of a project. Their layout is that of *Logix 5000 Controllers Import/Export* (1756-RM084)."""
