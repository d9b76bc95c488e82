/** What if: inputs of the recorded run of the selected PLC with other values: the form, and what came of it. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { memberOf, variableOf } from "../../logic/verify/verify";
import { shownValue } from "../../logic/verify/verifyValues";
import { FORM, type WhatIfForm, wantedOf } from "../../logic/verify/whatif";
import { t } from "../../text";
import type { VerifyDifference, VerifyRow, WhatIf } from "../../wire/types";
import { whatIf } from "../../wire/whatif";
import { saveFile } from "../page/download";
import { openPage } from "../page/navigate";
import { useBench } from "../plc/bench";
import { loadMembers } from "../plc/members";
import { useVerifyRows } from "./verifyRows";

interface WhatIfs {
  form: WhatIfForm;
  found: WhatIf | null;
  /** It is being tried. */
  busy: boolean;
  trouble: string | null;
}

const nothing = { found: null, busy: false, trouble: null };

export const useWhatIf = create<WhatIfs>(() => ({ form: FORM, ...nothing }));
const get = useWhatIf.getState;
const set = useWhatIf.setState;

export const changeWhatIf = (changed: Partial<WhatIfForm>) => set(({ form }) => ({ form: { ...form, ...changed } }));

/** Opens the page for the scan that is shown. */
export function showWhatIf(scan: number): void {
  changeWhatIf({ scan: String(scan) });
  openPage("whatif");
}

/** Opens the page for a row of a verification: which change of its inputs leads to its result? */
export async function askWhatIf(row: VerifyRow, difference: VerifyDifference | null): Promise<void> {
  const inside = row.instance === "" ? [] : await loadMembers(row.instance);
  const columns = useVerifyRows.getState().columns;
  const pathOf = (column: string) => memberOf(row.instance, inside, column.replace(/ \(global\)$/, ""));
  // The results of a function, the current result of IL and parts of a value are no paths of a variable that can be set.
  const isKnown = row.instance.includes(".") || row.instance === "" || inside.length > 0;
  const pathsOf = (names: readonly string[]) =>
    isKnown ? names.filter((name) => variableOf(null, `input:${name}`) !== null).map(pathOf) : [];
  const result = isKnown && difference?.control ? variableOf(difference, null) : null;
  const edited = Object.entries(row.inputs).flatMap(([name, { set }]) => {
    const column = columns.find((each) => each.name === name);
    return set === null || !column ? [] : [`${pathOf(name)} = ${shownValue(column, set).text}`];
  });
  set({ found: null, trouble: null });
  changeWhatIf({
    mode: edited.length > 0 ? "set" : "search",
    scan: String(row.scan),
    values: edited.join("; "),
    candidates: pathsOf(Object.keys(row.inputs)).join("; "),
    watch: pathsOf(Object.keys(row.outputs)).slice(0, WATCHED).join("; "),
    // The result of the control device: a change of inputs that leads to it would explain it.
    condition: difference && result ? `${pathOf(result)} = ${textOf(difference)}` : "",
  });
  openPage("whatif");
}

const textOf = (difference: VerifyDifference) => shownValue({ ...difference, values: [] }, difference.control).text;

const WATCHED = 5;
let asking: AbortController | null = null;

/** Tries what the form asks for. */
export async function tryWhatIf(): Promise<void> {
  const { instance } = useBench.getState();
  const wanted = wantedOf(get().form);
  if (instance === null) return;
  if (typeof wanted === "string") {
    set({ trouble: t("whatif.bad", { field: t(`whatif.${wanted}`) }) });
    return;
  }
  asking?.abort();
  const mine = new AbortController();
  asking = mine;
  set({ ...nothing, busy: true });
  try {
    const found = await whatIf(instance.id, wanted, mine.signal);
    if (asking === mine) set({ found });
  } catch (error) {
    if (asking === mine) set({ trouble: messageOf(error) });
  } finally {
    if (asking === mine) set({ busy: false });
  }
}

/** Gives up what is being tried. */
export function cancelWhatIf(): void {
  asking?.abort();
  asking = null;
  set({ busy: false });
}

/** Saves what was found as a scenario file: a test of the project. */
export function saveTest(text: string): void {
  const name = useBench.getState().instance?.name ?? "plc";
  saveFile(new Blob([text], { type: "application/yaml" }), `${name}.scenario.yaml`);
}

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) {
    asking?.abort();
    asking = null;
    set({ form: FORM, ...nothing });
  }
});
