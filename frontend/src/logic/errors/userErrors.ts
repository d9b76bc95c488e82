/** Errors that a project defines itself, as a form edits them: every field is a text, valid or not. */
import type { ModelInfo, UserAddress, UserDetail, UserError, UserProblem, UserText } from "../../wire/types";

/** The project's file that holds them. */
export const USER_ERRORS = "errors.xml";
const SEPARATOR = " / ";
const ID_LENGTH = 64;

/** A name as an id: `Pump 2 overheated` is `pump-2-overheated`; '' where no character of it may be in an id. */
export function idOf(name: string): string {
  const words = name.toLowerCase().match(/[a-z0-9]+/g) ?? [];
  return words
    .join("-")
    .replace(/^[0-9-]+/, "")
    .slice(0, ID_LENGTH)
    .replace(/-$/, "");
}

/** The id itself, or with the next number that is not used. */
export function freeId(wanted: string, taken: readonly string[]): string {
  const base = wanted.replace(/-\d+$/, "");
  let id = wanted;
  for (let n = 2; taken.includes(id); n++) id = `${base}-${n}`;
  return id;
}

export function textOf(texts: readonly UserText[], language: string, what: "name" | "description"): string {
  return texts.find((text) => text.language === language)?.[what] ?? "";
}

/** The texts with one of them changed; English comes first, and a language without texts is omitted. */
export function withText(
  texts: readonly UserText[],
  language: string,
  what: "name" | "description",
  value: string,
): UserText[] {
  const known = texts.find((text) => text.language === language) ?? { language, name: "", description: "" };
  const others = texts.filter((text) => text.language !== language);
  const all = [...others, { ...known, [what]: value }].filter(({ name, description }) => name || description);
  return all.sort((a, b) => rank(a.language) - rank(b.language) || a.language.localeCompare(b.language));
}

const rank = (language: string) => (language === "en" ? 0 : 1);

export const groupText = (group: readonly string[]) => group.join(SEPARATOR);

export const readGroup = (text: string) =>
  text
    .split("/")
    .map((name) => name.trim())
    .filter(Boolean);

const emptyAddress: UserAddress = {
  id: "",
  address: "",
  type: "Bit",
  shift: "",
  width: "",
  value: "",
  min: "",
  max: "",
  default: "",
  base: "",
  adds: "",
  texts: [],
};

export function newChoice(): UserAddress {
  return { ...emptyAddress };
}

export type Control = "List" | "Spin" | "Edit";

export function newDetail(control: Control, taken: readonly string[]): UserDetail {
  const first =
    control === "List" ? { ...newChoice(), id: "choice-1" } : { ...emptyAddress, type: "Word", min: "0", max: "9" };
  return {
    name: freeId(control === "List" ? "kind" : "number", taken),
    control,
    default: "",
    identifies: "",
    hardware: "",
    absent: "",
    addresses: [first],
    texts: [],
  };
}

/** A detail with a different control; the properties that both controls have stay. */
export function withControl(detail: UserDetail, control: Control): UserDetail {
  const [first = newChoice()] = detail.addresses;
  if (control === "List") {
    const { min: _min, max: _max, base: _base, default: _default, ...kept } = first;
    return { ...detail, control, default: "", addresses: [{ ...emptyAddress, ...kept }] };
  }
  const number = { ...first, id: "", value: "", type: first.type === "Bit" ? "Word" : first.type };
  const limits = { min: first.min || "0", max: first.max || "9" };
  return { ...detail, control, default: "", addresses: [{ ...number, ...limits }] };
}

/** A new error: in the group of the previous one, less severe than all others, with the next code. */
export function newError(errors: readonly UserError[], model: ModelInfo | null): UserError {
  const last = errors.at(-1);
  const priorities = errors.map((error) => Number(error.priority)).filter(Number.isInteger);
  return {
    id: "",
    group: last ? [...last.group] : ["Machine"],
    code: nextCode(errors, model),
    flag: "",
    severity: "nonfatal",
    priority: String(Math.max(999, ...priorities) + 1),
    cause: "",
    memory: "",
    source: "",
    verified: "",
    adds: "",
    hardware: "",
    texts: [],
    details: [],
    also: [],
  };
}

/** The code after the highest one of the project's own errors; '' for the first error, whose code cannot be guessed. */
function nextCode(errors: readonly UserError[], model: ModelInfo | null): string {
  const sample = errors.at(-1)?.code ?? (model ? firstCode(model) : "");
  const decimal = isDecimal(model);
  if (errors.length === 0 || !(decimal ? /^\d+$/ : /^[0-9a-f]+$/i).test(sample)) return "";
  const highest = Math.max(...errors.map((error) => Number.parseInt(error.code, decimal ? 10 : 16) || 0));
  const next = (highest + 1).toString(decimal ? 10 : 16).toUpperCase();
  return decimal ? next : next.padStart(sample.length, "0");
}

const firstCode = (model: ModelInfo): string => model.catalogue.flatMap((group) => group.errors)[0]?.code ?? "";

/** Devices show their codes in four or eight hexadecimal digits, or in decimal with any number of digits. */
function isDecimal(model: ModelInfo | null): boolean {
  const codes = model?.catalogue.flatMap(codesOf) ?? [];
  return codes.length > 0 && codes.every((code) => /^\d+$/.test(code)) && new Set(codes.map((c) => c.length)).size > 1;
}

const codesOf = (group: ModelInfo["catalogue"][number]): string[] => [
  ...group.errors.map((error) => error.code).filter(Boolean),
  ...group.groups.flatMap(codesOf),
];

export function duplicate(error: UserError, errors: readonly UserError[], model: ModelInfo | null): UserError {
  const id = freeId(
    error.id || "error",
    errors.map((other) => other.id),
  );
  return { ...structuredClone(error), id, code: nextCode(errors, model) };
}

/** Problems of one error, by the rest of their path: `flag`, `details.0.addresses.1.address`; '' is the error itself. */
export function problemsOf(problems: readonly UserProblem[], index: number): ReadonlyMap<string, string> {
  const found = new Map<string, string>();
  const own = `errors.${index}`;
  for (const { path, message } of problems) {
    if (path !== own && !path.startsWith(`${own}.`)) continue;
    const rest = path.slice(own.length + 1);
    if (!found.has(rest)) found.set(rest, message);
  }
  return found;
}

/** Problems that belong to no single error. */
export const generalProblems = (problems: readonly UserProblem[]) =>
  problems.filter(({ path }) => !path.startsWith("errors."));

/** An example error for a project that has none: its flag is a bit of the model that everybody may write. */
export function exampleFor(model: ModelInfo | null): UserError {
  const open = model?.areas.find(
    ({ program, tool, retain, name }) => program === "write" && tool === "write" && !retain && !OUTSIDE.test(name),
  );
  const flag = open ? bitOf(open.first) : "";
  const codes = model?.catalogue.flatMap(codesOf) ?? [];
  const decimal = isDecimal(model);
  const code = decimal ? freeCode(9000, codes, 0, 10) : freeCode(0x4f01, codes, codes[0]?.length ?? 4, 16);
  return {
    ...newError([], model),
    id: "pump-overheated",
    code,
    flag,
    texts: [
      { language: "en", name: "Pump overheated", description: "The temperature switch of a pump has opened." },
      { language: "ja", name: "ポンプ過熱", description: "ポンプの温度スイッチが開いた。" },
    ],
  };
}

/** Areas of inputs and outputs, which belong to the machine: an example's flag must not be there. */
const OUTSIDE = /^(CIO|X|Y|I|Q|%I|%Q)$/;

/** A bit some way into the area: `W0` is `W10.00`, `%MW0` is `%MX10.0`, `M0` (which counts bits) is `M100`. */
function bitOf(first: string): string {
  const iec = /^%M/.exec(first);
  if (iec) return "%MX100.0";
  const parts = /^([A-Z]+[0-9A-F]*_|[A-Z]+)\d+(\.\d+)?$/.exec(first);
  return parts ? `${parts[1]}10.00` : "";
}

function freeCode(from: number, taken: readonly string[], length: number, base: number): string {
  const show = (code: number) => code.toString(base).toUpperCase().padStart(length, "0");
  let code = length === 8 ? from * 0x10000 : from;
  while (taken.includes(show(code))) code += 1;
  return show(code);
}
