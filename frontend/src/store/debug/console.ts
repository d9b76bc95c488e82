/** The console of the debugger: expressions with their values, and the messages of logpoints. */
import { create } from "zustand";
import { type DebugProtocol, dap } from "../../wire/dap";
import { keep, recall } from "../page/localStorage";
import { usePlc } from "../plc/plc";
import { reasonOf } from "./debug";
import { useStack } from "./stack";

export interface ConsoleLine {
  id: number;
  kind: "input" | "value" | "error" | "log";
  text: string;
  type?: string;
  place?: { file: string; line: number };
  scan?: number;
}

interface Console {
  lines: readonly ConsoleLine[];
  /** Earlier entries, the last first. */
  history: readonly string[];
}

const LIMIT = 2000;
const REMEMBERED = 50;

export const useConsole = create<Console>(() => ({ lines: [], history: recall<string[]>("console", []) }));

let next = 0;

function say(line: Omit<ConsoleLine, "id">): void {
  next += 1;
  const fresh = { ...line, id: next };
  useConsole.setState(({ lines }) => ({ lines: [...lines, fresh].slice(-LIMIT) }));
}

export function clearConsole(): void {
  useConsole.setState({ lines: [] });
}

interface Evaluated {
  result: string;
  type?: string;
}

/** Evaluates an expression at the current statement. An expression that begins with `!` may change values; the change is a command like any other. */
export async function evaluate(expression: string): Promise<void> {
  const text = expression.trim();
  if (text === "") return;
  const history = [text, ...useConsole.getState().history.filter((kept) => kept !== text)].slice(0, REMEMBERED);
  useConsole.setState({ history });
  keep("console", history);
  say({ kind: "input", text });
  try {
    const found = await dap.request<Evaluated>("evaluate", { expression: text, context: "repl", ...inFrame() });
    say({ kind: "value", text: found.result, type: found.type });
  } catch (error) {
    say({ kind: "error", text: reasonOf(error) });
  }
}

interface Target {
  label: string;
  detail?: string;
  start: number;
}

/** What may follow a word: variables of the halted statement, instance paths and addresses. */
export async function completeHere(word: string): Promise<{ path: string; type: string }[]> {
  const asked = { text: word, column: word.length + 1, ...inFrame() };
  const { targets } = await dap.request<{ targets: Target[] }>("completions", asked);
  return targets.map(({ label, detail = "", start }) => ({ path: word.slice(0, start) + label, type: detail }));
}

function inFrame(): { frameId?: number } {
  const { frame } = useStack.getState();
  // A frame is valid only during its halt.
  const halted = usePlc.getState().state?.halt != null;
  return frame === null || !halted ? {} : { frameId: frame };
}

/** The value for a hover: in the frame if the text belongs to one, else of a path. Undefined when there is none. */
export async function worthOf(expression: string, inside: boolean): Promise<Evaluated | undefined> {
  try {
    const where = inside ? inFrame() : {};
    return await dap.request<Evaluated>("evaluate", { expression, context: "hover", ...where });
  } catch {
    return undefined;
  }
}

interface Output {
  category?: string;
  output: string;
  source?: DebugProtocol.Source;
  line?: number;
  scanbench?: { scan?: number };
}

dap.on("output", (body) => {
  const { output, source, line, category, scanbench } = body as Output;
  const place = source?.path && line ? { file: source.path, line } : undefined;
  say({ kind: category === "stderr" ? "error" : "log", text: output.replace(/\n$/, ""), place, scan: scanbench?.scan });
});
