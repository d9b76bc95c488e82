/** The text of the program that is shown: in a past that another version ran, that version's, as it ran; else what is edited. */
import { create } from "zustand";
import { rest } from "../wire/rest";
import type { Pou, ProgramText } from "../wire/types";
import { useBench } from "./bench";
import { messageOf, useDocuments } from "./documents";
import { type Plc, usePlc } from "./plc";

interface ShownProgram {
  /** The version that ran in the past that is shown; null while the texts of the project are shown. */
  version: number | null;
  /** Null until it has come. */
  program: ProgramText | null;
  refused: string | null;
}

const edited: ShownProgram = { version: null, program: null, refused: null };

export const useShownProgram = create<ShownProgram>(() => edited);

/** What ran does not change any more: each version is fetched once. */
const fetched = new Map<string, ProgramText>();

function follow(): void {
  const { state } = usePlc.getState();
  const { instance, project } = useBench.getState();
  const version = state?.past && state.program_version !== project?.version ? state.program_version : null;
  if (version === useShownProgram.getState().version) return;
  if (version === null || instance === null) {
    useShownProgram.setState(edited);
    return;
  }
  const key = `${instance.id}:${version}`;
  const program = fetched.get(key) ?? null;
  useShownProgram.setState({ version, program, refused: null });
  if (program === null) void load(instance.id, version, key);
}

/** A PLC that could not be asked may be asked again: there is a connection once more, or it is in another state. */
const isBack = (now: Plc, before: Plc) =>
  now.link.state === "open" && (before.link.state !== "open" || now.state?.state !== before.state?.state);

function tryAgain(): void {
  const { version, refused } = useShownProgram.getState();
  const { instance } = useBench.getState();
  if (version === null || refused === null || instance === null) return;
  useShownProgram.setState({ refused: null });
  void load(instance.id, version, `${instance.id}:${version}`);
}

/** How often a PLC came back. */
let returns = 0;

async function load(instance: number, version: number, key: string): Promise<void> {
  const before = returns;
  const shown = () => useShownProgram.getState().version === version && useBench.getState().instance?.id === instance;
  try {
    const program = await rest.programText(instance, version);
    fetched.set(key, program);
    if (shown()) useShownProgram.setState({ program });
  } catch (error) {
    if (!shown()) return;
    useShownProgram.setState({ refused: messageOf(error) });
    if (returns !== before) tryAgain();
  }
}

usePlc.subscribe((now, before) => {
  const back = isBack(now, before);
  if (back) returns += 1;
  if (now.state !== before.state) follow();
  if (back) tryAgain();
});
useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) {
    fetched.clear();
    useShownProgram.setState(edited);
  }
  follow();
});

interface ShownText {
  text: string;
  /** What the program that is shown was built from; lines that the PLC names are lines of it. */
  built: string;
  pous: readonly Pou[];
}

/** A file as its editor shows it. */
export function shownText(path: string): ShownText {
  const { version, program } = useShownProgram.getState();
  if (version !== null) {
    const text = program?.files[path] ?? "";
    return { text, built: text, pous: program?.pous ?? [] };
  }
  const { open, pous } = useDocuments.getState();
  return { text: open[path]?.text ?? "", built: open[path]?.savedText ?? "", pous };
}
