"""Names of Logix as names of the standard."""

import re

from scanbench.syntax.lexer import KEYWORDS

LIBRARY = "Logix"
"""The library whose texts are the types and instructions of Logix."""
INSTRUCTIONS = frozenset(
    "BTDT CONCAT CTUD DEG DELETE DFF DTOS FIND HLL INSERT LADDER_CTD LADDER_CTU LADDER_RTO LADDER_TOF LADDER_TON LOWER MID "
    "MVMT OSFI OSRI RAD RESD RTOR SCL SETD STOD STOR TOFR TONR UPPER".split()
)
"""What it has for statements, in upper case."""
TYPES = frozenset(
    """
    ALARM ALARM_ANALOG ALARM_DIGITAL CONTROL COUNTER DOMINANT_RESET DOMINANT_SET FBD_BIT_FIELD_DISTRIBUTE FBD_COUNTER FBD_MASKED_MOVE
    FBD_ONESHOT FBD_TIMER FLIP_FLOP_D HL_LIMIT MESSAGE MOTION_INSTRUCTION SCALE TIMER
    """.split()
)
"""And the types."""
AXES = re.compile(r"AXIS_(?:CIP_DRIVE|CONSUMED|GENERIC|GENERIC_DRIVE|SERVO|SERVO_DRIVE|VIRTUAL)", re.IGNORECASE)
"""Types of axes, which are one here."""
STUBS = frozenset(
    """
    ALM ALMA ALMD CC CMPTR DEDT DERV EVENT ESEL FGEN HMIBC HPF IMC INTG LDL2 LDLG LPF MAAT MAFR MAG MAH MAHD MAJ MAM MAOC MAPC
    MAR MAS MASD MASR MATC MAVE MAW MAXC MCCD MCCM MCCP MCD MCLM MCS MCSD MCSR MCSV MCT MCTO MCTP MCTPO MDAC MDCC MDF MDO MDOC MDR MDS MDW
    MGPS MGS MGSD MGSP MGSR MINC MMC MRAT MRHD MRP MSF MSG MSO MSTD NTCH PATT PCLF PCMD PDET PFL PI PID PIDE PMUL POSP POVR PPD PRNP
    PSC PXRQ RLIM RMPS SCRV SFP SFR SNEG SOC SRT SRTP SSUM TOT UPDN
    """.split()
)
"""Instructions that need a device, or of which there is no text: a stub each, which leaves the tags of the call as they are."""
NOTHING = frozenset("IOT UID UIE".split())
"""Instructions that change nothing here: no task interrupts another one, and outputs have no device."""
CONTROLLER = "Controller"
"""The library that is made for a project: what its controller would do, and nothing here does."""
TEXT = f"{LIBRARY}.STRING82"
"""The type STRING of Logix: a length and characters."""
ELEMENTARY = frozenset("BOOL SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL".split())
OWN = "="
"""Before the name of a type that the file defines itself, where Logix has one of that name as well."""
_TAKEN = (
    KEYWORDS
    | ELEMENTARY
    | frozenset("BYTE WORD DWORD LWORD TIME LTIME DATE LDATE TOD LTOD DT LDT CHAR WCHAR STRING WSTRING".split())
)
_SPECIAL = re.compile(r"\W")


def name_of(logix: str) -> str:
    """The name here: `Local:1:I` is Local_1_I, and what is a word of the standard gets a `_`."""
    plain = _SPECIAL.sub("_", logix)
    return f"{plain}_" if plain.upper() in _TAKEN else plain


def type_name(logix: str) -> str:
    """The type here."""
    upper = logix.upper()
    if upper.startswith(OWN):
        return name_of(logix[1:])
    if upper in ELEMENTARY:
        return upper
    if upper in ("BIT", "BOOLEAN"):
        return "BOOL"
    if upper == "STRING":
        return TEXT
    if AXES.fullmatch(upper):
        return f"{LIBRARY}.AXIS"
    return f"{LIBRARY}.{upper}" if upper in TYPES else name_of(logix)
