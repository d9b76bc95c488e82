/** The virtual PLC this browser is connected to: state, users, errors and log, as the server last reported them. */

import { create } from "zustand";
import { byKind, type Rows, withRows } from "../../logic/plc/errorInstances";
import { type Deed, forbidden } from "../../logic/plc/permits";
import { t } from "../../text";
import type { LinkStatus } from "../../wire/socket";
import type {
  ArmedFault,
  BrokenLine,
  Diagnostics,
  ErrorHistoryRow,
  Hello,
  InstanceState,
  LogLine,
  User,
} from "../../wire/types";
import { setClock } from "./clock";

export type { LinkStatus } from "../../wire/socket";

const LOG_LIMIT = 5000;

export interface Plc {
  link: LinkStatus;
  state: InstanceState | null;
  you: User | null;
  users: User[];
  /** One row for each kind of error; the rows of its instances together. */
  errors: ReadonlyMap<string, ErrorHistoryRow>;
  /** The row of each error instance, by its key. */
  instances: Rows;
  /** Scheduled and recurring faults that are not over. */
  armed: readonly ArmedFault[];
  /** Lines to clients of the communication unit that something is wrong with. */
  lines: readonly BrokenLine[];
  log: readonly LogLine[];
  /** Violations that the compiler's embedded checks found while the program ran. */
  diagnostics: Diagnostics;
  /** Who deleted the PLC that is shown; null while it is there. */
  deletedBy: string | null;
}

const NO_DIAGNOSTICS: Diagnostics = { type: "diagnostics", violations: [], dropped: 0, count: 0 };

const nothing: Plc = {
  link: { state: "none", lostAt: null, attempt: 0, nextTryAt: null },
  state: null,
  you: null,
  users: [],
  errors: new Map(),
  instances: new Map(),
  armed: [],
  lines: [],
  log: [],
  diagnostics: NO_DIAGNOSTICS,
  deletedBy: null,
};

export const usePlc = create<Plc>(() => nothing);

/** True when commands can be sent. */
export const useOnline = () => usePlc((plc) => plc.link.state === "open");

/** True when a connection existed and was lost; a project without an instance has no connection. */
export const useLost = () => usePlc((plc) => plc.link.state === "lost");

/** Why something cannot be done to the PLC now, as a text; null when it can be done. */
export function useForbidden(deed: Deed): string | null {
  const key = usePlc((plc) => forbidden(plc.state, plc.link.state === "open", deed));
  return key === null ? null : t(key);
}

export function resetPlc(): void {
  usePlc.setState({ ...nothing, link: usePlc.getState().link });
}

const known = (instances: Rows) => ({ instances, errors: byKind(instances) });

export function onHello(hello: Hello): void {
  const { state } = hello.instance;
  setClock(state.scan, state.time_ns);
  usePlc.setState({
    state,
    you: hello.you,
    users: hello.users,
    ...known(withRows(new Map(), hello.errors)),
    armed: hello.armed,
    lines: hello.lines.broken,
    log: hello.log,
    diagnostics: hello.diagnostics,
  });
}

export function onState(state: InstanceState): void {
  setClock(state.scan, state.time_ns);
  usePlc.setState({ state });
}

/** Rows that changed, or all there are: what is not among those is not there any more. */
export function onErrors(rows: readonly ErrorHistoryRow[], whole: boolean): void {
  usePlc.setState(({ instances }) => known(withRows(whole ? new Map() : instances, rows)));
}

export function onLog(lines: readonly LogLine[]): void {
  usePlc.setState(({ log }) => ({ log: [...log, ...lines].slice(-LOG_LIMIT) }));
}
