/** The device's own view of its errors, as a tool reads it from the PLC's memory, and what a tool does about them. */

import { create } from "zustand";
import { deviceKey } from "../../logic/errors/device";
import { send } from "../../wire/send";
import type { DeviceErrors } from "../../wire/types";
import { onInstanceChange } from "../plc/reset";
import { recoverErrors } from "./recovering";

interface Device {
  /** Null until the PLC was there once. */
  found: DeviceErrors | null;
  outcome: { ok: boolean; message: string } | null;
}

const nothing: Device = { found: null, outcome: null };

export const useDevice = create<Device>(() => nothing);
const set = useDevice.setState;

onInstanceChange(() => set(nothing));

/** What was done is told until an error comes that was not there: then it is not true any more. */
export const onDevice = (found: DeviceErrors | null) =>
  set(({ found: before, outcome }) => ({ found, outcome: came(before, found) || found?.past ? null : outcome }));

function came(before: DeviceErrors | null, found: DeviceErrors | null): boolean {
  const known = new Set(before?.errors.map(deviceKey));
  return found?.errors.some((error) => !known.has(deviceKey(error))) ?? false;
}

/** Clears errors as a tool does it on the device: the most serious one, or all that it lets go. */
export const clearErrors = (what: "current" | "all") => report(send({ type: "clear_errors", what }));

export const clearErrorLog = () => report(send({ type: "clear_error_log" }));

/** Takes an error back at the simulator: its cause is gone, too. */
export const recoverPresent = (id: string) => report(recoverErrors([id]));

/** The CPU Unit that failed is the standby again; no error is present that would be recovered with it. */
export const repairStandby = () => report(send({ type: "recover", ids: null }));

async function report(answer: ReturnType<typeof send>): Promise<void> {
  set({ outcome: null });
  const { ok, message } = await answer;
  set({ outcome: { ok, message } });
}
