"""Binary value frames: what the watch tap sends, 20 times a second at most, and only what changed.

Little endian, made in the PLC's own process and passed on unread by the web process:

    u8 kind = 1 | u8 full (1: a snapshot of every watched value) | u16 0 | u32 count | u64 scan | i64 time_ns
    u32 id[count]                 padded with zeros to a multiple of 8 bytes
    u8[8] value[count]            the raw bytes of the variable, zero padded; BOOL is 0 or 1, TIME is i64 nanoseconds
    u32 strings | strings x { u32 id, u32 length, u8 byte[length] }     current contents: a STRING one byte a character
                                  (Latin-1), a WSTRING two (UTF-16); of a reference what it refers to, by name (UTF-8):
                                  `-> Main.tank[3].level`, `NULL`

A value wider than 8 bytes that is not a STRING (array, structure, block) is never in a frame: its members are watched.
"""
