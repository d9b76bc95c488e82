/** Short names for the wire shapes; the shapes themselves are generated (`messages.gen.ts`). */
import type { components } from "./messages.gen";

type Shapes = components["schemas"];

export type ChangeTrace = Shapes["ChangeTrace"];
export type DefineTrace = Shapes["DefineTrace"];
export type Retrospective = Shapes["Retrospective"];
export type TraceDefinition = Shapes["TraceDefinition"];
export type TraceInfo = Shapes["TraceInfo"];
export type TraceRecordInfo = Shapes["TraceRecordInfo"];
export type TraceSignal = Shapes["TraceSignal"];
export type TraceTrigger = Shapes["TraceTrigger"];
export type TraceWhen = TraceTrigger["when"];
export type AppInfo = Shapes["AppInfo"];
export type Area = Shapes["Area"];
export type ArmedFault = Shapes["ArmedFault"];
export type BreakpointInfo = Shapes["BreakpointInfo"];
export type Binding = Shapes["Binding"];
export type BoundTo = Shapes["BoundTo"];
export type BuildResult = Shapes["BuildResult"];
export type CheckResult = Shapes["CheckResult"];
export type Coverage = Shapes["Coverage"];
export type CoveredFile = Shapes["CoveredFile"];
export type CoveredSite = Shapes["CoveredSite"];
export type ChangeInstance = Shapes["ChangeInstance"];
export type Channel = Shapes["Channel"];
export type ChannelUnit = Shapes["ChannelUnit"];
export type DeviceDetail = Shapes["DeviceDetail"];
export type DeviceError = Shapes["DeviceError"];
export type DeviceErrors = Shapes["DeviceErrors"];
export type DeviceRecord = Shapes["DeviceRecord"];
export type DeviceStandby = Shapes["DeviceStandby"];
export type Diagnostics = Shapes["Diagnostics"];
export type Done = Shapes["Done"];
export type Draft = Shapes["Draft"];
export type DraftEdited = Shapes["DraftEdited"];
export type Task = Shapes["Task"];
export type EmbeddedCheck = Shapes["EmbeddedCheck"];
export type ErrorDetail = Shapes["ErrorDetail"];
export type ErrorGroup = Shapes["ErrorGroup"];
export type ErrorHistoryRow = Shapes["ErrorHistoryRow"];
export type ErrorInfo = Shapes["ErrorInfo"];
export type FaultShape = Shapes["FaultShape"];
export type FaultStart = Shapes["FaultStart"];
export type FileInfo = Shapes["FileInfo"];
export type FileText = Shapes["FileText"];
export type ForceInfo = Shapes["ForceInfo"];
export type GenerateOne = Shapes["GenerateOne"];
export type HaltInfo = Shapes["HaltInfo"];
export type HistoryOfVersion = Shapes["HistoryOfVersion"];
export type HistoryVersion = Shapes["HistoryVersion"];
export type ImportedInstance = Shapes["ImportedInstance"];
export type ImportedRecord = Shapes["ImportedRecord"];
export type ProjectArchive = Shapes["ProjectArchive"];
export type ProjectDialect = Shapes["ProjectDialect"];
export type ProjectLibrary = Shapes["ProjectLibrary"];
export type UnsavedText = Shapes["UnsavedText"];
export type ProjectTemplate = Shapes["ProjectTemplate"];
export type ProjectVersion = Shapes["ProjectVersion"];
export type CommitText = Shapes["CommitText"];
export type GitCommit = Shapes["GitCommit"];
export type GitStatus = Shapes["GitStatus"];
export type NewCommit = Shapes["NewCommit"];
export type VersionText = Shapes["VersionText"];
export type RecordInfo = Shapes["RecordInfo"];
export type TestRecord = Shapes["TestRecord"];
export type Here = Shapes["Here"];
export type People = Shapes["People"];
export type Person = Shapes["Person"];
export type HardwareKind = Shapes["HardwareKind"];
export type Hello = Shapes["Hello"];
export type Invitation = Shapes["Invitation"];
export type Instance = Shapes["Instance"];
export type InstanceLimits = Shapes["InstanceLimits"];
export type InstanceLoad = Shapes["InstanceLoad"];
export type InstanceState = Shapes["InstanceState"];
export type LogLine = Shapes["LogLine"];
export type LogPage = Shapes["LogPage"];
export type LostVariable = Shapes["LostVariable"];
export type Mark = Shapes["Mark"];
export type Mode = InstanceState["mode"];
export type MemoryPlace = Shapes["MemoryPlace"];
export type MemoryWord = Shapes["MemoryWord"];
export type WordsFound = Shapes["WordsFound"];
export type ModelInfo = Shapes["ModelInfo"];
export type ModelSummary = Shapes["ModelSummary"];
export type OnlineChange = Shapes["OnlineChange"];
export type Pou = Shapes["Pou"];
export type PreviewedErrors = Shapes["PreviewedErrors"];
export type PreviewedWrite = Shapes["PreviewedWrite"];
export type Problem = Shapes["Problem"];
export type Project = Shapes["Project"];
export type Refusal = Shapes["Refusal"];
export type RestartKind = Shapes["Restart"]["kind"];
export type RunState = InstanceState["state"];
export type SaveConflict = Shapes["SaveConflict"];
export type PlcSymbol = Shapes["Symbol"];
export type Timeline = Shapes["Timeline"];
export type TimelineInfo = Shapes["TimelineInfo"];
export type User = Shapes["User"];
export type Violation = Shapes["Violation"];
export type Watched = Shapes["Watched"];
export type WatchEntry = Required<Shapes["WatchEntry"]>;
export type WatchList = Omit<Shapes["WatchList"], "entries"> & { entries: WatchEntry[] };
export type WatchListChanged = Shapes["WatchListChanged"];
export type WatchListInfo = Shapes["WatchListInfo"];

export type BetweenEntry = Shapes["BetweenEntry"];
export type Comparison = Shapes["Comparison"];
export type LastWriter = Shapes["LastWriter"];
export type NewRerun = Required<Shapes["NewRerun"]>;
export type Rerun = Shapes["Rerun"];
export type RunChanges = Shapes["RunChanges"];
export type RunDivergence = Shapes["RunDivergence"];
export type VariableChange = Shapes["VariableChange"];

export type Accepted = Shapes["Accepted"];
export type CellRef = Shapes["CellRef"];
export type NewSweep = Required<Shapes["NewSweep"]>;
export type ProgramState = Shapes["ProgramState"];
export type ProgramText = Shapes["ProgramText"];
export type RaisedNumber = Shapes["RaisedNumber"];
export type Reaction = Shapes["Reaction"];
export type ReactionState = Shapes["ReactionState"];
export type Sweep = Shapes["Sweep"];
export type SweepCell = Shapes["SweepCell"];
export type SweepChange = Shapes["SweepChange"];
export type SweepComparison = Shapes["SweepComparison"];
export type SweepError = Shapes["SweepError"];
export type SweepProgress = Shapes["SweepProgress"];
export type SweepSummary = Shapes["SweepSummary"];
export type Verdict = NonNullable<SweepCell["verdict"]>;

export type ServerMessage = Shapes["ServerMessage"];

export type ClientMessage = Shapes["ClientMessage"];

type WithoutRef<T> = T extends { ref: number } ? Omit<T, "ref"> : never;

type Run = Extract<ClientMessage, { type: "run" }>;

/** A run order contains only what differs from the default. */
export type RunOrder = Pick<Run, "action"> & Partial<Pick<Run, "speed" | "scans" | "until">>;

/** What a panel may send: answered by one `Done`; the reference is added when it is sent. */
export type Command = WithoutRef<Exclude<ClientMessage, { type: "watch" } | { type: "unwatch" } | { type: "here" }>>;

export type UserText = Shapes["UserText"];
export type UserAddress = Omit<Shapes["UserAddress"], "texts"> & { texts: UserText[] };
export type UserDetail = Omit<Shapes["UserDetail"], "addresses" | "texts"> & {
  addresses: UserAddress[];
  texts: UserText[];
};
export type UserError = Omit<Shapes["UserError"], "texts" | "details" | "also"> & {
  texts: UserText[];
  details: UserDetail[];
  also: Shapes["UserAlso"][];
};
export type UserProblem = Shapes["UserProblem"];
export type UserErrorsDraft = { errors: UserError[]; groups: Shapes["UserGroup"][] };
export type UserErrors = Omit<Shapes["UserErrors"], "errors" | "groups"> & UserErrorsDraft;

export type CheckTraceMapping = Shapes["CheckTraceMapping"];
export type CommandResult = Shapes["CommandResult"];
export type DisturbanceInfo = Shapes["DisturbanceInfo"];
export type NewDisturbance = Required<Shapes["NewDisturbance"]>;
export type NewTraceVerification = Shapes["NewTraceVerification"];
export type SavedMapping = Omit<Shapes["SavedMapping"], "mapping"> & { mapping: TraceMapping };
export type TraceColumnMap = Required<Shapes["TraceColumnMap"]>;
export type TraceMapping = Required<Omit<Shapes["TraceMapping"], "columns">> & { columns: TraceColumnMap[] };
export type TraceMappingChecked = Shapes["TraceMappingChecked"];
export type TraceProblem = Shapes["TraceProblem"];
export type UploadedTrace = Omit<Shapes["UploadedTrace"], "mapping"> & { mapping: TraceMapping };

export type DriveVerification = Required<Shapes["DriveVerification"]>;
export type NewVerification = Required<Shapes["NewVerification"]>;
export type SetCell = Shapes["SetCell"];
export type VerificationInfo = Shapes["VerificationInfo"];
export type VerificationRecord = Shapes["VerificationRecord"];
export type VerifyColumn = Shapes["VerifyColumn"];
export type VerifyDifference = Shapes["VerifyDifference"];
export type VerifyOutput = Shapes["VerifyOutput"];
export type VerifyPlace = Shapes["VerifyPlace"];
export type VerifyRow = Shapes["VerifyRow"];
export type VerifyRows = Shapes["VerifyRows"];
export type VerifyUse = Shapes["VerifyUse"];
