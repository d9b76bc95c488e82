/** The REST routes of the backend (`web/README.md` there), typed and thin. */
import type {
  Accepted,
  AppInfo,
  Binding,
  BuildResult,
  CellRef,
  ChangeInstance,
  Channel,
  CheckResult,
  Communication,
  CommunicationFault,
  CommunicationServerSettings,
  ExchangeFile,
  ExchangeForm,
  FileInfo,
  FileText,
  Flows,
  GenerateOne,
  HistoryOfVersion,
  HistoryVersion,
  ImportedRecord,
  Instance,
  Invitation,
  LineKind,
  LogLine,
  LogPage,
  MemoryPlace,
  MemoryWord,
  ModbusRange,
  ModelInfo,
  ModelSummary,
  MqttSettingsGiven,
  NewSweep,
  PlantSettings,
  PlcSymbol,
  PreviewedErrors,
  ProgramState,
  ProgramText,
  Project,
  ProjectArchive,
  ProjectDialect,
  ProjectLibrary,
  ProjectSubranges,
  ProjectTemplate,
  ProjectVersion,
  Reaction,
  RecordInfo,
  Refusal,
  SaveConflict,
  ServerKind,
  Sweep,
  SweepComparison,
  SweepSummary,
  UnsavedText,
  UserErrors,
  UserErrorsDraft,
  UserProblem,
  VersionText,
  WatchEntry,
  WatchList,
  WatchListInfo,
  WordsFound,
} from "./types";

/** A request that the server refused: the reason, and what to do next, in the server's words. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    readonly refusal: Refusal,
  ) {
    super(refusal.message);
  }
}

/** A request without an answer: the server does not run, or cannot be reached. The browser's own message for it says nothing useful. */
export class NoConnection extends Error {
  /** `reading`: the request could not have changed anything. */
  constructor(reading: boolean) {
    super(words(reading));
  }
}

let words = (_reading: boolean): string => "No connection to the server.";

/** Sets the message, in the language of the page. */
export function sayNoConnection(inWords: (reading: boolean) => string): void {
  words = inWords;
}

/** Awaits a network operation. An interrupted one is a TypeError in every browser. */
async function reached<T>(method: string, work: Promise<T>): Promise<T> {
  try {
    return await work;
  } catch (error) {
    throw error instanceof TypeError ? new NoConnection(method === "GET") : error;
  }
}

export async function request(
  method: string,
  path: string,
  body?: unknown,
  alsoFine: number[] = [],
  signal?: AbortSignal,
): Promise<Response> {
  const response = await reached(
    method,
    fetch(`/api${path}`, {
      method,
      credentials: "same-origin",
      ...(signal ? { signal } : {}),
      ...(body === undefined ? {} : body instanceof Blob ? { body } : inJson(body)),
    }),
  );
  if (response.ok || alsoFine.includes(response.status)) return response;
  throw new Refused(response.status, await readRefusal(response));
}

const inJson = (body: unknown) => ({
  headers: { "Content-Type": "application/json" },
  body: JSON.stringify(body),
});

async function readRefusal(response: Response): Promise<Refusal> {
  const plain = { message: `${response.status} ${response.statusText}`, near: [] };
  try {
    const body = (await response.json()) as Partial<Refusal>;
    return typeof body.message === "string" ? { message: body.message, near: body.near ?? [] } : plain;
  } catch {
    return plain;
  }
}

/** A file or samples; so large that the connection may be lost in the middle. */
export async function blob(path: string): Promise<Blob> {
  return reached("GET", (await request("GET", path)).blob());
}

export async function bytes(path: string): Promise<ArrayBuffer> {
  return reached("GET", (await request("GET", path)).arrayBuffer());
}

export async function json<T>(method: string, path: string, body?: unknown, signal?: AbortSignal): Promise<T> {
  const response = await request(method, path, body, [], signal);
  return (await reached(method, response.json())) as T;
}

const filePath = (project: number, path: string) =>
  `/projects/${project}/files/${path.split("/").map(encodeURIComponent).join("/")}`;

type SaveResult = { saved: FileInfo } | { conflict: SaveConflict };

interface ListOnServer {
  name: string;
  shared: boolean;
  groups: readonly string[];
  entries: readonly WatchEntry[];
}

async function savedErrors(answer: Promise<Response>): Promise<{ saved: UserErrors } | { conflict: SaveConflict }> {
  const response = await answer;
  if (response.status === 409) return { conflict: (await response.json()) as SaveConflict };
  return { saved: (await response.json()) as UserErrors };
}

export const rest = {
  app: (signal?: AbortSignal) => json<AppInfo>("GET", "", undefined, signal),

  /** The token that lets somebody else in. */
  invite: () => json<Invitation>("POST", "/invitations"),
  /** `template`: what it begins with; empty is a project without files. */
  createProject: (name: string, model: string, template: string) =>
    json<Project>("POST", "/projects", { name, model, ...(template && { template }) }),
  templates: () => json<ProjectTemplate[]>("GET", "/templates"),
  /** What a zip file has of a project. */
  lookAtArchive: (file: Blob) => json<ProjectArchive>("POST", "/archives", file),
  unpackProject: (name: string, model: string, file: Blob) =>
    json<Project>("POST", `/archives/projects?${new URLSearchParams({ name, model })}`, file),
  versions: (project: number) => json<ProjectVersion[]>("GET", `/projects/${project}/versions`),
  version: (project: number, version: number) => json<VersionText>("GET", `/projects/${project}/versions/${version}`),
  describeVersion: (project: number, version: number, label: string, message: string) =>
    json<ProjectVersion>("PATCH", `/projects/${project}/versions/${version}`, { label, message }),
  /** The program of a project as a file for other tools, as it is saved. */
  writeProject: (project: number, form: ExchangeForm) =>
    json<ExchangeFile>("GET", `/projects/${project}/plcopen?${new URLSearchParams({ form })}`),
  packProject: (project: number) => blob(`/projects/${project}/archive`),
  dialect: (project: number) => json<ProjectDialect>("GET", `/projects/${project}/dialect`),
  changeDialect: (project: number, dialect: ProjectDialect["dialect"]) =>
    json<ProjectDialect>("PUT", `/projects/${project}/dialect`, { dialect }),
  subranges: (project: number) => json<ProjectSubranges>("GET", `/projects/${project}/subranges`),
  changeSubranges: (project: number, policies: ProjectSubranges["policies"]) =>
    json<ProjectSubranges>("PUT", `/projects/${project}/subranges`, { policies }),
  libraries: (project: number) => json<ProjectLibrary[]>("GET", `/projects/${project}/libraries`),
  addLibrary: (project: number, name: string) =>
    json<FileInfo>("POST", `/projects/${project}/libraries/${encodeURIComponent(name)}`),
  /** Texts that somebody edited, and nobody saved since. */
  drafts: (project: number) => json<UnsavedText[]>("GET", `/projects/${project}/drafts`),
  files: (project: number) => json<FileInfo[]>("GET", `/projects/${project}/files`),
  file: (project: number, path: string) => json<FileText>("GET", filePath(project, path)),
  /** `draft`: that the text is of; without one the server makes a change of its draft of it. */
  save: async (
    project: number,
    path: string,
    text: string,
    version: number,
    draft?: string | undefined,
  ): Promise<SaveResult> => {
    const response = await request("PUT", filePath(project, path), { text, version, draft }, [409]);
    if (response.status === 409) return { conflict: (await response.json()) as SaveConflict };
    return { saved: (await response.json()) as FileInfo };
  },
  deleteFile: async (project: number, path: string): Promise<void> => {
    await request("DELETE", filePath(project, path));
  },
  check: (project: number, files: Record<string, string>, numbers = false) =>
    json<CheckResult>("POST", `/projects/${project}/check`, numbers ? { files, numbers } : { files }),
  /** `instances`: the PLCs that get the program; null is all of them. */
  build: (project: number, agreed: boolean, instances: readonly number[] | null = null, message = "") =>
    json<BuildResult>("POST", `/projects/${project}/build`, { agreed, instances, message }),

  userErrors: (project: number) => json<UserErrors>("GET", `/projects/${project}/user-errors`),
  checkUserErrors: (project: number, draft: UserErrorsDraft) =>
    json<{ problems: UserProblem[] }>("POST", `/projects/${project}/user-errors/check`, draft),
  saveUserErrors: (project: number, draft: UserErrorsDraft & { version: number }) =>
    savedErrors(request("PUT", `/projects/${project}/user-errors`, draft, [409])),
  importUserErrors: (project: number, file: Blob, how: "replace" | "add", version: number) =>
    savedErrors(request("POST", `/projects/${project}/user-errors/import?how=${how}&version=${version}`, file, [409])),
  exportUserErrors: (project: number): Promise<Blob> => blob(`/projects/${project}/user-errors/export`),

  models: () => json<ModelSummary[]>("GET", "/models"),
  model: (name: string) => json<ModelInfo>("GET", `/models/${encodeURIComponent(name)}`),

  /** The model with the project's own errors, as the running program knows it. */
  instanceModel: (instance: number) => json<ModelInfo>("GET", `/instances/${instance}/model`),
  previewErrors: (instance: number, errors: readonly GenerateOne[], again: boolean, anyway: boolean) =>
    json<PreviewedErrors>("POST", `/instances/${instance}/errors/preview`, { errors, again, anyway }),
  reaction: (instance: number, error: string) =>
    json<Reaction>("GET", `/instances/${instance}/errors/${encodeURIComponent(error)}/reaction`),

  /** The program versions with an error history, the newest first. */
  historyVersions: (instance: number) => json<HistoryVersion[]>("GET", `/instances/${instance}/history/versions`),
  historyOf: (instance: number, version: number) =>
    json<HistoryOfVersion>("GET", `/instances/${instance}/history?version=${version}`),
  records: (project: number) => json<RecordInfo[]>("GET", `/projects/${project}/records`),
  logPage: (instance: number, first: number | null, kind: LogLine["kind"] | null) => {
    const wanted = new URLSearchParams();
    if (first !== null) wanted.set("first", String(first));
    if (kind !== null) wanted.set("kind", kind);
    return json<LogPage>("GET", `/instances/${instance}/log?${wanted}`);
  },
  record: (project: number, record: number) => json<ImportedRecord>("GET", `/projects/${project}/records/${record}`),
  importRecord: (project: number, file: Blob) => json<RecordInfo>("POST", `/projects/${project}/records`, file),
  deleteRecord: async (project: number, record: number): Promise<void> => {
    await request("DELETE", `/projects/${project}/records/${record}`);
  },

  /** The files that somebody edited and nobody saved. */
  unsaved: (project: number) => json<string[]>("GET", `/projects/${project}/unsaved`),

  instances: () => json<Instance[]>("GET", "/instances"),
  createInstance: (project: number, name: string) => json<Instance>("POST", "/instances", { project, name }),
  changeInstance: (instance: number, change: Partial<ChangeInstance>) =>
    json<Instance>("PATCH", `/instances/${instance}`, change),
  /** A new instance that begins with the state of this one before a scan; null is now. A look ends when nobody is there. */
  branch: (instance: number, name: string, scan: number | null, look: boolean) =>
    json<Instance>("POST", `/instances/${instance}/branch`, { name, scan, look }),
  deleteInstance: async (instance: number): Promise<void> => {
    await request("DELETE", `/instances/${instance}`);
  },
  exportRun: (instance: number, signal: AbortSignal) =>
    request("GET", `/instances/${instance}/export`, undefined, [], signal),
  states: (project: number) => json<ProgramState[]>("GET", `/projects/${project}/states`),
  /** Keeps the state of the PLC before a scan; null is now. */
  keepState: (instance: number, name: string, scan: number | null) =>
    json<ProgramState>("POST", `/instances/${instance}/states`, { name, scan }),
  deleteState: async (state: number): Promise<void> => {
    await request("DELETE", `/states/${state}`);
  },
  sweeps: (project: number) => json<SweepSummary[]>("GET", `/projects/${project}/sweeps`),
  sweep: (sweep: number) => json<Sweep>("GET", `/sweeps/${sweep}`),
  beginSweep: (instance: number, wanted: NewSweep) =>
    json<SweepSummary>("POST", `/instances/${instance}/sweeps`, wanted),
  cancelSweep: (sweep: number) => json<SweepSummary>("POST", `/sweeps/${sweep}/cancel`),
  resumeSweep: (sweep: number) => json<SweepSummary>("POST", `/sweeps/${sweep}/resume`),
  deleteSweep: async (sweep: number): Promise<void> => {
    await request("DELETE", `/sweeps/${sweep}`);
  },
  sweepReaction: (sweep: number, { error, state }: CellRef) =>
    json<Reaction>("POST", `/sweeps/${sweep}/reaction`, { error, state }),
  acceptFinding: (sweep: number, { error, state }: CellRef, reason: string) =>
    json<Accepted>("POST", `/sweeps/${sweep}/accept`, { error, state, reason }),
  withdrawFinding: async (sweep: number, { error, state }: CellRef): Promise<void> => {
    await request("POST", `/sweeps/${sweep}/withdraw`, { error, state });
  },
  /** A new PLC with this state and this error raised, paused. */
  openCell: (sweep: number, { error, state }: CellRef, name: string) =>
    json<Instance>("POST", `/sweeps/${sweep}/open`, { error, state, name }),
  compareSweeps: (before: number, after: number) => json<SweepComparison>("GET", `/sweeps/${before}/compare/${after}`),

  watchLists: (project: number) => json<WatchListInfo[]>("GET", `/projects/${project}/watch-lists`),
  watchList: (list: number) => json<WatchList>("GET", `/watch-lists/${list}`),
  createWatchList: (project: number, list: ListOnServer) =>
    json<WatchList>("POST", `/projects/${project}/watch-lists`, list),
  /** Saves a text that is based on `version`; answers with the text of somebody else who was first. */
  saveWatchList: async (
    id: number,
    list: ListOnServer,
    version: number,
  ): Promise<{ saved: WatchList } | { theirs: WatchList }> => {
    const response = await request("PUT", `/watch-lists/${id}`, { ...list, version }, [409]);
    const answer = (await response.json()) as WatchList | { theirs?: WatchList; message: string };
    if (response.status !== 409) return { saved: answer as WatchList };
    if ("theirs" in answer && answer.theirs) return { theirs: answer.theirs };
    throw new Refused(409, { message: (answer as { message: string }).message, near: [] });
  },
  deleteWatchList: async (id: number): Promise<void> => {
    await request("DELETE", `/watch-lists/${id}`);
  },

  binding: (instance: number, path: string) =>
    json<Binding>("GET", `/instances/${instance}/binding?path=${encodeURIComponent(path)}`),

  flow: (
    instance: number,
    { pou, path, call, first, last }: { pou: string; path: string; call: number; first: number; last: number },
  ) =>
    json<Flows>(
      "GET",
      `/instances/${instance}/flow?${new URLSearchParams({ pou, path, call: String(call), first: String(first), last: String(last) })}`,
    ),

  memoryPlace: (instance: number, path: string) =>
    json<MemoryPlace>("GET", `/instances/${instance}/memory?path=${encodeURIComponent(path)}`),
  memoryWords: (instance: number, area: string, first: number, count: number) =>
    json<MemoryWord[]>(
      "GET",
      `/instances/${instance}/memory/${encodeURIComponent(area)}/words?first=${first}&count=${count}`,
    ),
  memoryFind: (instance: number, area: string, value: bigint, bits: number, first: number) =>
    json<WordsFound>(
      "GET",
      `/instances/${instance}/memory/${encodeURIComponent(area)}/find?value=${value}&bits=${bits}&first=${first}`,
    ),
  communication: (instance: number) => json<Communication>("GET", `/instances/${instance}/communication`),
  setCommunication: (instance: number, kind: ServerKind, wanted: CommunicationServerSettings) =>
    json<Communication>("PUT", `/instances/${instance}/communication/${kind}`, wanted),
  setPlant: (instance: number, wanted: PlantSettings) =>
    json<Communication>("PUT", `/instances/${instance}/communication/plant`, wanted),
  setMqtt: (instance: number, wanted: MqttSettingsGiven) =>
    json<Communication>("PUT", `/instances/${instance}/communication/mqtt`, wanted),
  breakLine: (instance: number, kind: LineKind, fault: CommunicationFault) =>
    json<Communication>("PUT", `/instances/${instance}/communication/${kind}/fault`, fault),
  modbusMap: (instance: number) => json<ModbusRange[]>("GET", `/instances/${instance}/communication/modbus/map`),
  rack: (instance: number) => json<Channel[]>("GET", `/instances/${instance}/rack`),
  symbols: (instance: number, path: string) =>
    json<PlcSymbol[]>("GET", `/instances/${instance}/symbols?path=${encodeURIComponent(path)}`),
  /** A program version as it ran in the instance. */
  programText: (instance: number, version: number) =>
    json<ProgramText>("GET", `/instances/${instance}/program?version=${version}`),
  /** The instances of a POU in the running program. */
  instancesOf: (instance: number, pou: string) =>
    json<PlcSymbol[]>("GET", `/instances/${instance}/instances-of?pou=${encodeURIComponent(pou)}`),
  complete: (instance: number, text: string) =>
    json<PlcSymbol[]>("GET", `/instances/${instance}/complete?text=${encodeURIComponent(text)}`),
};
