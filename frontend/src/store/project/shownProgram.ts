/** The text of the shown program: in the past the text that ran, if it differs from the saved one; else the edited text. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { Pou, ProgramText } from "../../wire/types";
import { useBench } from "../plc/bench";
import { type Plc, usePlc } from "../plc/plc";
import { useDocuments } from "./documents";

interface ShownProgram {
  /** The version that ran at the shown scan of the past; null while the page is live. */
  version: number | null;
  /** Whether the project was built since: then none of its texts is what ran. */
  older: boolean;
  /** Null until it has been fetched. */
  program: ProgramText | null;
  refused: string | null;
}

const edited: ShownProgram = { version: null, older: false, program: null, refused: null };

export const useShownProgram = create<ShownProgram>(() => edited);

/** A version that ran never changes: each is fetched once. */
const fetched = new Map<string, ProgramText>();

function follow(): void {
  const { state } = usePlc.getState();
  const { instance, project } = useBench.getState();
  const version = state?.past ? state.program_version : null;
  const older = version !== null && version !== project?.version;
  const shown = useShownProgram.getState();
  if (version === shown.version) {
    if (older !== shown.older) useShownProgram.setState({ older });
    return;
  }
  if (version === null || instance === null) {
    useShownProgram.setState(edited);
    return;
  }
  const key = `${instance.id}:${version}`;
  const program = fetched.get(key) ?? null;
  useShownProgram.setState({ version, older, program, refused: null });
  if (program === null) void load(instance.id, version, key);
}

/** A PLC that could not answer is asked again: the connection is back, or its state has changed. */
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
  if (now.instance?.id === before.instance?.id) return follow();
  // Its state has not come yet: the one that is known is that of the PLC before.
  fetched.clear();
  asked.clear();
  useShownProgram.setState(edited);
});

/** Whether the editor of a file shows the text that ran, read-only, and not the edited text. */
export function showsRan(path: string): boolean {
  const { version, older, program } = useShownProgram.getState();
  if (version === null || older) return version !== null;
  const document = useDocuments.getState().open[path];
  return program !== null && document !== undefined && document.savedText !== program.files[path];
}

export function useShowsRan(path: string): boolean {
  useDocuments(() => showsRan(path));
  return useShownProgram(() => showsRan(path));
}

/** The version that ran at the shown scan of the past, if the project is no longer that version; else null. */
export function ranApart(): number | null {
  const { version, older } = useShownProgram.getState();
  return older || Object.keys(useDocuments.getState().open).some(showsRan) ? version : null;
}

/** For panels that continue to show the project: the version, with the shown scan. */
export function useRanApart(): { version: number; scan: number } | null {
  useDocuments(ranApart);
  const version = useShownProgram(ranApart);
  const scan = usePlc(({ state }) => (state?.past ? state.scan : 0));
  return version === null ? null : { version, scan };
}

interface ShownText {
  text: string;
  /** The text that the shown program was built from; line numbers of the PLC refer to it. */
  built: string;
  pous: readonly Pou[];
}

/** A file as its editor shows it. */
export function shownText(path: string): ShownText {
  if (showsRan(path)) {
    const { program } = useShownProgram.getState();
    const text = program?.files[path] ?? "";
    return { text, built: text, pous: program?.pous ?? [] };
  }
  const { open, pous } = useDocuments.getState();
  return { text: open[path]?.text ?? "", built: ranText(path) ?? open[path]?.savedText ?? "", pous };
}

/** While the saved texts have an error, what runs is what was built before: that text of a file. Null where it is the saved one, or not known yet. */
function ranText(path: string): string | null {
  const { state } = usePlc.getState();
  const { instance } = useBench.getState();
  if (!state || !instance || !useDocuments.getState().problems.some(({ severity }) => severity === "error"))
    return null;
  const key = `${instance.id}:${state.program_version}`;
  const known = fetched.get(key);
  if (known) return known.files[path] ?? "";
  if (!asked.has(key)) {
    asked.add(key);
    rest.programText(instance.id, state.program_version).then(
      (program) => {
        fetched.set(key, program);
        // Whoever shows the text looks again.
        useShownProgram.setState({});
      },
      () => asked.delete(key),
    );
  }
  return null;
}

const asked = new Set<string>();
