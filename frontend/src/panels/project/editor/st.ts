/** Structured Text for Monaco: tokens and indentation rules. */
import type { languages } from "monaco-editor/editor";

export const LANGUAGE = "iecst";

const keywords =
  `AND ARRAY AT BY CASE CONFIGURATION CONSTANT DO ELSE ELSIF END_CASE END_CONFIGURATION END_FOR END_FUNCTION
END_FUNCTION_BLOCK END_IF END_PROGRAM END_REPEAT END_RESOURCE END_STRUCT END_TYPE END_VAR END_WHILE EXIT CONTINUE FOR FUNCTION
FUNCTION_BLOCK IF MOD NOT OF OR PROGRAM REPEAT RESOURCE RETAIN NON_RETAIN RETURN STRUCT TASK THEN TO TYPE UNTIL VAR
VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL VAR_IN_OUT VAR_INPUT VAR_OUTPUT VAR_TEMP WHILE WITH XOR R_EDGE F_EDGE
INTERVAL PRIORITY SINGLE CLASS END_CLASS INTERFACE END_INTERFACE METHOD END_METHOD PROPERTY END_PROPERTY GET SET END_GET END_SET
NAMESPACE END_NAMESPACE USING UNION END_UNION EXTENDS IMPLEMENTS OVERRIDE ABSTRACT FINAL THIS SUPER PUBLIC PRIVATE PROTECTED
INTERNAL REF_TO REFERENCE POINTER REF NULL OVERLAP PERSISTENT AND_THEN OR_ELSE END_RUNG END_NETWORK END_STEP END_TRANSITION
__TRY __CATCH __FINALLY __ENDTRY`.split(/\s+/);

const types = `BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME LTIME DATE TOD DT
TIME_OF_DAY DATE_AND_TIME STRING WSTRING CHAR WCHAR LDATE LTOD LDT LTIME_OF_DAY LDATE_AND_TIME TON TOF TP CTU CTD CTUD R_TRIG F_TRIG SR RS`.split(
  /\s+/,
);

export const tokenizer: languages.IMonarchLanguage = {
  ignoreCase: true,
  defaultToken: "",
  keywords,
  types,
  constants: ["TRUE", "FALSE"],
  tokenizer: {
    root: [
      // Operators of Instruction List are the first word of their line; elsewhere they are ordinary names.
      [
        /^\s*(LDN?|STN?|S|R|JMP(CN?)?|CAL(CN?)?|RET(CN?)?|(AND|OR|XOR)N?|ADD|SUB|MUL|DIV|[GLN][ET]|EQ)(?=\(|\s+[\w%'"#]|\s*$)/,
        "keyword",
      ],
      // Elsewhere RUNG, NETWORK, STEP and TRANSITION are names.
      [/^\s*(INITIAL_STEP|STEP)\b(?=\s+\w+\s*:)/, "keyword"],
      [/^\s*TRANSITION\b(?=[^:=]*\bFROM\b)/, "keyword"],
      [/\bFROM\b(?=\s*[\w(][^:]*\bTO\b)/, "keyword"],
      [/^\s*(RUNG|NETWORK)\b(?=\s*(\w+\s*:\s*)?("[^"]*")?\s*($|\/\/|\(\*))/, "keyword"],
      // `RESOURCE r ON model`; elsewhere `on` is a common variable name.
      [/\bON\b(?=\s+[A-Z_][\w-]*\s*($|\/\/|\(\*))/, "keyword"],
      [/\(\*/, "comment", "@comment"],
      [/\/\*/, "comment", "@ccomment"],
      [/\/\/.*$/, "comment"],
      [/\{[^}]*\}/, "annotation"],
      [/'/, "string", "@string"],
      [/"/, "string", "@wstring"],
      [/%[IQM][XBWDL]?[\d.*]+/, "variable.predefined"],
      [/[A-Z_]\w*_TO_[A-Z_]\w*(?=\s*\()/, "type"],
      [/(L?T|L?TIME|L?D|L?DATE|L?TOD|L?DT|L?TIME_OF_DAY|L?DATE_AND_TIME)#[\w.+\-:]+/, "number"],
      [/([A-Z_]\w*#)?(2#[01_]+|8#[0-7_]+|16#[\dA-F_]+)/, "number"],
      [/(BYTE|WORD|DWORD|LWORD|[US]?S?I?D?L?INT|L?REAL|BOOL)#/, "type"],
      [/\d[\d_]*(\.\d[\d_]*)?(E[+-]?\d+)?/, "number"],
      [
        /[A-Za-z_\u00c0-\uffff][\w\u00c0-\uffff]*/,
        { cases: { "@keywords": "keyword", "@types": "type", "@constants": "number", "@default": "identifier" } },
      ],
      [/[;,.()[\]:=<>+\-*/&]+/, "delimiter"],
    ],
    comment: [
      [/[^*(]+/, "comment"],
      [/\*\)/, "comment", "@pop"],
      [/\(\*/, "comment", "@push"],
      [/[*(]/, "comment"],
    ],
    ccomment: [
      [/[^*]+/, "comment"],
      [/\*\//, "comment", "@pop"],
      [/\*/, "comment"],
    ],
    string: [
      [/\$./, "string.escape"],
      [/'/, "string", "@pop"],
      [/[^'$]+/, "string"],
      [/$/, "string", "@pop"],
    ],
    wstring: [
      [/\$./, "string.escape"],
      [/"/, "string", "@pop"],
      [/[^"$]+/, "string"],
      [/$/, "string", "@pop"],
    ],
  },
};

/** A line after which the next line is one level deeper. */
export const opens =
  /^\s*(IF|CASE|FOR|WHILE|REPEAT|PROGRAM|FUNCTION(_BLOCK)?|CLASS|INTERFACE|METHOD|PROPERTY|NAMESPACE|TYPE|VAR(_\w+)?|CONFIGURATION|RESOURCE)\b(?!.*\bEND_\w+)|:\s*STRUCT\s*$|^\s*(ELSE|ELSIF)\b/i;
const closes = /^\s*(END_\w+|ELSE|ELSIF|UNTIL)\b/i;

export const configuration: languages.LanguageConfiguration = {
  comments: { lineComment: "//", blockComment: ["(*", "*)"] },
  brackets: [
    ["(", ")"],
    ["[", "]"],
  ],
  surroundingPairs: [
    { open: "(", close: ")" },
    { open: "[", close: "]" },
    { open: "'", close: "'" },
  ],
  indentationRules: { increaseIndentPattern: opens, decreaseIndentPattern: closes },
  folding: {
    markers: {
      start:
        /^\s*(IF|CASE|FOR|WHILE|REPEAT|PROGRAM|FUNCTION(_BLOCK)?|CLASS|INTERFACE|METHOD|PROPERTY|NAMESPACE|TYPE|VAR(_\w+)?|CONFIGURATION|RESOURCE)\b(?!.*\bEND_)/i,
      end: /^\s*(END_(IF|CASE|FOR|WHILE|REPEAT|PROGRAM|FUNCTION|FUNCTION_BLOCK|CLASS|INTERFACE|METHOD|PROPERTY|NAMESPACE|TYPE|VAR|CONFIGURATION|RESOURCE))\b/i,
    },
  },
};
