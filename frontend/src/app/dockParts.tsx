import type { IDockviewHeaderActionsProps, IDockviewPanelHeaderProps, IDockviewPanelProps } from "dockview-react";
import {
  type FunctionComponent,
  type MouseEvent,
  type ReactNode,
  useCallback,
  useEffect,
  useState,
  useSyncExternalStore,
} from "react";
import { baseName } from "../logic/format/paths";
import { isPanelFile, panelName } from "../logic/project/panelFiles";
import { ConsolePanel } from "../panels/debug/console/ConsolePanel";
import { HistoryPanel } from "../panels/errors/history/HistoryPanel";
import { ErrorsPanel } from "../panels/errors/tree/ErrorsPanel";
import { PanelEnd } from "../panels/errors/tree/PanelEnd";
import { StepsPanel } from "../panels/graphic/StepsPanel";
import { OperatorPanel } from "../panels/operator/OperatorPanel";
import { EditorPanel } from "../panels/project/editor/EditorPanel";
import { ProblemsPanel } from "../panels/project/problems/ProblemsPanel";
import { SearchPanel } from "../panels/project/search/SearchPanel";
import { DiagnosticsPanel } from "../panels/shell/diagnostics/DiagnosticsPanel";
import { LogPanel } from "../panels/shell/log/LogPanel";
import { TracePanel } from "../panels/trace/TracePanel";
import { DisturbPanel } from "../panels/verify/disturb/DisturbPanel";
import { VerifyPanel } from "../panels/verify/table/VerifyPanel";
import { ForcesPanel } from "../panels/watch/forces/ForcesPanel";
import { WatchPanel } from "../panels/watch/table/WatchPanel";
import { useOperatorPanels } from "../store/operator/panels";
import { type PageName, pageOf } from "../store/page/navigate";
import { usePlc } from "../store/plc/plc";
import { isDirty, useDocuments } from "../store/project/documents";
import { t } from "../text";
import { Boundary } from "../ui/Boundary";
import { Icon, type IconName } from "../ui/Icon";
import { InSight } from "../ui/inSight";
import type { Pou } from "../wire/types";
import { closeByHand } from "./closing";
import { fileOf } from "./layout";
import { PageEnd } from "./PageEnd";
import { PAGES, pageComponents } from "./pages";
import { Start } from "./Start";

const panels = {
  start: Start,
  editor: ({ params: { path } }: IDockviewPanelProps<{ path: string }>) =>
    isPanelFile(path) ? <PanelFile path={path} /> : <EditorPanel path={path} />,
  watch: WatchPanel,
  trace: TracePanel,
  steps: StepsPanel,
  verify: VerifyPanel,
  forces: ForcesPanel,
  problems: ProblemsPanel,
  search: SearchPanel,
  diagnostics: DiagnosticsPanel,
  log: LogPanel,
  console: ConsolePanel,
  errors: ErrorsPanel,
  disturb: DisturbPanel,
  history: HistoryPanel,
  ...pageComponents,
};

/** A panel is loaded when it is first shown, and knows whether it is in sight. What fails in it ends that panel only. */
const bounded = (Panel: FunctionComponent<IDockviewPanelProps>) =>
  function Bounded(props: IDockviewPanelProps) {
    const { inSight, seen } = useSeen(props.api);
    if (!seen) return null;
    return (
      <Boundary>
        <InSight value={inSight}>
          <Panel {...props} />
        </InSight>
      </Boundary>
    );
  };

function useSeen(api: IDockviewPanelProps["api"]): { inSight: boolean; seen: boolean } {
  const inSight = useSyncExternalStore(
    useCallback(
      (tell) => {
        const listening = api.onDidVisibilityChange(tell);
        return () => listening.dispose();
      },
      [api],
    ),
    () => api.isVisible,
  );
  const [seen, setSeen] = useState(inSight);
  if (inSight && !seen) setSeen(true);
  return { inSight, seen };
}

export const components = Object.fromEntries(
  Object.entries<FunctionComponent<IDockviewPanelProps>>(panels).map(([name, panel]) => [name, bounded(panel)]),
);

/** An operator panel; where its text cannot be drawn, that text, to be repaired. */
function PanelFile({ path }: { path: string }) {
  const wrong = useOperatorPanels(({ open }) => open[path]?.wrong != null);
  return (
    <div className="panelfile">
      <OperatorPanel path={path} />
      {wrong && <EditorPanel path={path} />}
    </div>
  );
}

/** The tab of a panel: icon and name, a mark for unsaved text, the number of problems. */
export function PanelTab({ api, containerApi }: IDockviewPanelHeaderProps) {
  const path = fileOf(api.id);
  const page = pageOf(api.id);
  if (page) return <PageTab page={page} api={api} onClose={() => closeByHand(containerApi, api.id)} />;
  if (path === undefined) return <FixedTab api={api} />;
  return <FileTab path={path} api={api} onClose={() => closeByHand(containerApi, api.id)} />;
}

type PanelApi = IDockviewPanelHeaderProps["api"];

/** Dockview takes the tab's accessible name from the panel's title. */
function useTitle(api: PanelApi, title: string): void {
  useEffect(() => {
    if (api.title !== title) api.setTitle(title);
  }, [api, title]);
}

function FixedTab({ api }: { api: PanelApi }) {
  const problems = useDocuments((documents) => (api.id === "problems" ? documents.problems.length : 0));
  const violations = usePlc((plc) => (api.id === "diagnostics" ? plc.diagnostics.violations.length : 0));
  const count = problems + violations;
  const name = t(`panel.${api.id as "watch"}`);
  useTitle(api, count > 0 ? `${name} (${count})` : name);
  return (
    <span className="tab" data-panel={api.id}>
      {name}
      {count > 0 && <span className="n">{count}</span>}
    </span>
  );
}

const ICONS: Record<Pou["kind"], IconName> = {
  program: "program",
  function_block: "fb",
  function: "fn",
  class: "fb",
  interface: "struct",
  method: "fn",
  action: "fn",
  property: "fn",
  type: "struct",
  global: "globe",
};

function FileTab({ path, api, onClose }: { path: string; api: PanelApi; onClose: () => void }) {
  const dirty = useDocuments((documents) => isDirty(documents.open[path]));
  const kind = useDocuments((documents) => documents.pous.find((pou) => pou.file === path)?.kind);
  const panel = isPanelFile(path);
  const name = panel ? panelName(path) : baseName(path);
  useTitle(api, dirty ? `${name}, ${t("unsaved")}` : name);
  return (
    <ClosableTab panel={api.id} name={path} onClose={onClose}>
      <Icon name={panel ? "layout" : kind ? ICONS[kind] : "init"} small />
      {name}
      {dirty && <span className="dirty" title={t("unsaved")} />}
    </ClosableTab>
  );
}

function PageTab({ page, api, onClose }: { page: PageName; api: PanelApi; onClose: () => void }) {
  const { icon, useTitle: usePageTitle } = PAGES[page];
  const title = usePageTitle();
  useTitle(api, title);
  return (
    <ClosableTab panel={api.id} name={page} onClose={onClose}>
      <Icon name={icon} small />
      {title}
    </ClosableTab>
  );
}

interface ClosableProps {
  panel: string;
  name: string;
  onClose: () => void;
  children: ReactNode;
}

function ClosableTab({ panel, name, onClose, children }: ClosableProps) {
  const close = (event: MouseEvent) => {
    event.preventDefault();
    event.stopPropagation();
    onClose();
  };
  return (
    <span
      className="tab"
      title={name}
      data-panel={panel}
      data-closes={panel}
      onAuxClick={(event) => event.button === 1 && close(event)}
    >
      {children}
      {/* Not a button, because a tab must not contain one. The keyboard closes a tab with Delete. */}
      <span
        className="x"
        title={t("close")}
        data-testid={`close:${name}`}
        onPointerDown={(event) => event.stopPropagation()}
        onClick={close}
      >
        <Icon name="x" small />
      </span>
    </span>
  );
}

/** The end of a tab strip: actions of the whole error simulator, and those of the panel itself. */
export function HeaderEnd(props: IDockviewHeaderActionsProps) {
  return (
    <span className="headerend">
      {props.activePanel?.id === "errors" && <PanelEnd />}
      <PageEnd {...props} />
    </span>
  );
}
