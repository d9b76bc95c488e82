/** Operating: writes through the PLC's one door, one after the other for each control, with the reason where it refuses. */

import { create } from "zustand";
import { t } from "../../text";
import { send } from "../../wire/send";
import { useBench } from "../plc/bench";
import { readClock } from "../plc/clock";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";

/** Why the last write of a control was refused, by the name of the control. */
export const useRefused = create<{ of: ReadonlyMap<string, string> }>(() => ({ of: new Map() }));

onInstanceChange(() => {
  useRefused.setState({ of: new Map() });
  busy.clear();
  pressed.clear();
});

interface Next {
  path: string;
  value: string;
}

/** Controls whose write is under way, with what comes next: of those between only the last one counts. */
const busy = new Map<string, Next | null>();

/** Writes a value for a control; while one of its writes is under way, the next waits. */
export async function operate(control: string, path: string, value: string): Promise<void> {
  if (busy.has(control)) {
    busy.set(control, { path, value });
    return;
  }
  const instance = useBench.getState().instance?.id;
  for (let next: Next | null = { path, value }; next !== null; next = busy.get(control) ?? null) {
    busy.set(control, null);
    const answer = await send({ type: "write", path: next.path, value: next.value, site: "" });
    if (useBench.getState().instance?.id !== instance) return; // the queue is that of a different PLC
    note(control, answer.ok ? null : answer.message || t("operator.notsent"));
  }
  busy.delete(control);
}

function note(control: string, refusal: string | null): void {
  const { of } = useRefused.getState();
  if (of.get(control) === (refusal ?? undefined)) return;
  const next = new Map(of);
  if (refusal === null) next.delete(control);
  else next.set(control, refusal);
  useRefused.setState({ of: next });
}

export const forgetRefusal = (control: string) => note(control, null);

// ---- push buttons -----------------------------------------------------------------------------------------------------

/** Variables that a push button of this page holds at TRUE: whether it was let go, and a scan has seen the press. */
const pressed = new Map<string, { control: string; letGo: boolean; seen: boolean }>();

/** TRUE from now on, until `release`. The server lets go by itself when this page is gone. */
export async function press(control: string, path: string): Promise<void> {
  if (pressed.has(path)) return;
  const push = { control, letGo: false, seen: false };
  pressed.set(path, push);
  const answer = await send({ type: "press", path, down: true });
  if (pressed.get(path) !== push) return;
  note(control, answer.ok ? null : answer.message || t("operator.notsent"));
  if (!answer.ok) {
    pressed.delete(path);
    return;
  }
  await scanAfter(answer.scan ?? 0); // else a short press could begin and end between two scans
  push.seen = true;
  if (push.letGo) await letGo(path);
}

export function release(path: string): void {
  const push = pressed.get(path);
  if (!push) return;
  push.letGo = true;
  if (push.seen) void letGo(path);
}

/** What cannot be let go now is let go as soon as the PLC takes it. */
async function letGo(path: string): Promise<void> {
  const push = pressed.get(path);
  if (!push) return;
  const answer = await send({ type: "press", path, down: false });
  if (pressed.get(path) !== push) return;
  note(push.control, answer.ok ? null : t("operator.stillheld", { path, message: answer.message }));
  if (answer.ok) pressed.delete(path);
}

usePlc.subscribe(({ state, link }, before) => {
  const regained = link.state === "open" && before.link.state !== "open";
  const changed = state?.mode !== before.state?.mode || state?.past !== before.state?.past;
  if (!regained && !changed) return;
  for (const [path, { letGo: wanted }] of pressed) if (wanted || regained) void letGo(path);
});

const LOOK_MS = 40;

/** Resolves once a later scan ran; also in a window that is not drawn, and after a restart, which counts from 0 again. */
function scanAfter(scan: number): Promise<void> {
  return new Promise((seen) => {
    let last = readClock().scan;
    const looking = setInterval(() => {
      const now = readClock().scan;
      if (now > scan || now < last) {
        clearInterval(looking);
        seen();
      }
      last = now;
    }, LOOK_MS);
  });
}
