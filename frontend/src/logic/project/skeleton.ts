/** The first text of a new file. */
import { declares, isRequirements, isTable } from "./explorer";

export const KINDS = ["program", "function_block", "function", "class", "interface", "type", "global"] as const;
export type NewKind = (typeof KINDS)[number];

const LANGUAGES = ["ST", "IL", "LD", "FBD", "SFC"] as const;
export type NewLanguage = (typeof LANGUAGES)[number];

/** A function keeps nothing from call to call, so it is no chart. */
export const languagesOf = (kind: NewKind) => LANGUAGES.filter((each) => each !== "SFC" || kind !== "function");

/** Only what has a body is written in a language. */
export const hasBody = (kind: NewKind) => kind === "program" || kind === "function_block" || kind === "function";

/** What a name says by the usual prefixes. */
export function kindOf(path: string): NewKind {
  const name = nameOf(path);
  if (/^fb/i.test(name)) return "function_block";
  if (/^(fc|fn|f_)/i.test(name)) return "function";
  if (/^(st_|t_|e_)/i.test(name)) return "type";
  return "program";
}

/** `input` is an address that a table can drive. */
export function skeleton(
  path: string,
  { kind = kindOf(path), language = "ST", input = "%IX0.0" }: Partial<Chosen> = {},
): string {
  if (isTable(path))
    return `# What the inputs are, and when. A row holds until the next one.\ntime; ${input}\n0; 0\n500; 1\n`;
  if (isRequirements(path))
    return "// What must happen when errors come and go, e.g.\n// battery-error:\n//   lamp within 3 scans\n";
  if (!declares(path)) return ""; // it is pasted as a whole: nobody types XML
  if (!hasBody(kind) || language === "ST") return ST[kind](nameOf(path));
  return language === "IL" ? IL[kind](nameOf(path)) : drawn(kind, language, nameOf(path));
}

interface Chosen {
  kind: NewKind;
  language: NewLanguage;
  input: string;
}

/** What a file declares: its name without folders and ending. That may have blanks where a declaration cannot. */
export const nameOf = (path: string) =>
  path
    .replace(/^.*\//, "")
    .replace(/\.[^.]*$/, "")
    .replace(/[^\p{L}\d_]/gu, "_");

type Texts = Readonly<Record<NewKind, (name: string) => string>>;

const ST: Texts = {
  program: (name) => `PROGRAM ${name}\nVAR\nEND_VAR\n\nEND_PROGRAM\n`,
  function_block: (name) =>
    `FUNCTION_BLOCK ${name}\nVAR_INPUT\nEND_VAR\nVAR_OUTPUT\nEND_VAR\nVAR\nEND_VAR\n\nEND_FUNCTION_BLOCK\n`,
  function: (name) => `FUNCTION ${name} : INT\nVAR_INPUT\nEND_VAR\n\n${name} := 0;\nEND_FUNCTION\n`,
  class: (name) => `CLASS ${name}\nVAR\nEND_VAR\n\nMETHOD PUBLIC run\nEND_METHOD\n\nEND_CLASS\n`,
  interface: (name) => `INTERFACE ${name}\n\nMETHOD run\nEND_METHOD\n\nEND_INTERFACE\n`,
  type: (name) => `TYPE\n  ${name} : STRUCT\n    value : INT;\n  END_STRUCT;\nEND_TYPE\n`,
  global: () => "VAR_GLOBAL\nEND_VAR\n",
};

/** A body without an instruction would be in no language: it begins with two. */
const IL: Texts = {
  ...ST,
  program: (name) => `PROGRAM ${name}\nVAR\n  enable : BOOL;\n  done : BOOL;\nEND_VAR\n\n${INSTRUCTIONS}END_PROGRAM\n`,
  function_block: (name) =>
    `FUNCTION_BLOCK ${name}\nVAR_INPUT\n  enable : BOOL;\nEND_VAR\nVAR_OUTPUT\n  done : BOOL;\nEND_VAR\n\n${INSTRUCTIONS}END_FUNCTION_BLOCK\n`,
  function: (name) =>
    `FUNCTION ${name} : INT\nVAR_INPUT\n  value : INT;\nEND_VAR\n\n    LD   value\n    ST   ${name}\nEND_FUNCTION\n`,
};

const INSTRUCTIONS = "    LD   enable\n    ST   done\n";

/** A POU whose body is drawn begins with an empty rung or network, or with the step that is active first. */
const FIRST: Record<"LD" | "FBD" | "SFC", string> = {
  LD: "RUNG\nEND_RUNG\n",
  FBD: "NETWORK\nEND_NETWORK\n",
  SFC: "INITIAL_STEP Init:\nEND_STEP\n",
};

const drawn = (kind: NewKind, language: keyof typeof FIRST, name: string) =>
  ST[kind](name).replace(/\n\n(?:.*;\n)?(END_\w+\n)$/, `\n${FIRST[language]}$1`);

/** Words of the language that can be the name of nothing. */
const WORDS =
  /^(?:AND|ARRAY|AT|BY|CASE|CLASS|CONFIGURATION|CONSTANT|CONTINUE|DO|ELSE|ELSIF|EXIT|FALSE|FOR|FUNCTION|FUNCTION_BLOCK|IF|INTERFACE|METHOD|MOD|NAMESPACE|NOT|OF|OR|PROGRAM|REPEAT|RESOURCE|RETAIN|RETURN|STRUCT|TASK|THEN|TO|TRUE|TYPE|UNTIL|VAR|WHILE|WITH|XOR|END_\w+|VAR_\w+)$/i;

/** Whether a POU or a type can have this name. */
export const isPouName = (name: string) => /^[\p{L}_][\p{L}\p{N}_]*$/u.test(name) && !WORDS.test(name);
