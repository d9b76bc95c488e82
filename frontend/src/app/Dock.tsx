import { type DockviewApi, DockviewReact, type DockviewReadyEvent } from "dockview-react";
import "dockview-react/dist/styles/dockview.css";
import {
  type KeyboardEvent,
  type MouseEvent,
  type Ref,
  useCallback,
  useEffect,
  useImperativeHandle,
  useRef,
  useState,
} from "react";
import { keep, recall } from "../store/page/localStorage";
import { onNavigate } from "../store/page/navigate";
import { useBench } from "../store/plc/bench";
import { closeDocument, holdsUnsaved, useDocuments } from "../store/project/documents";
import { announcement } from "./announcements";
import { CloseUnsaved } from "./CloseUnsaved";
import { closeByHand } from "./closing";
import { components, HeaderEnd, PanelTab } from "./dockParts";
import {
  closeFiles,
  closeTab,
  enlarge,
  fileOf,
  offerFilePanel,
  openFilePanel,
  openPagePanel,
  restoreLayout,
  showFixedPanel,
  standardLayout,
  widePanels,
} from "./layout";
import { beginWith, popOutActive } from "./popOut";
import { keepTabsInSight } from "./tabs";

export interface DockHandle {
  reset: () => void;
  /** Gives the active panel the whole dock, or brings the others back. */
  enlarge: () => void;
  /** Opens the active panel in a window of its own. */
  popOut: () => void;
}

interface Props {
  ref: Ref<DockHandle>;
  /** A window of its own: it begins with this panel, and its arrangement is not kept. `onTitle` is told what its tab in front says. */
  alone?: { panel: string; onTitle: (title: string) => void };
}

/** Increase this when the default layout changes: a layout kept from an older version would hide the change. */
const LAYOUT = "layout.5";
const THEME = { name: "scanbench", className: "dockview-theme-scanbench" };

/** The dockable part of the window. The layout is kept in this browser. */
export function Dock({ ref, alone }: Props) {
  const api = useRef<DockviewApi | null>(null);
  const element = useRef<HTMLDivElement>(null);
  const tabs = useRef<ReturnType<typeof keepTabsInSight> | null>(null);
  useEffect(() => {
    if (!element.current) return;
    const kept = keepTabsInSight(element.current);
    tabs.current = kept;
    return kept.stop;
  }, []);
  const project = useBench((bench) => bench.project?.id ?? null);
  const [begins] = useState(alone);

  const reset = useCallback(() => {
    if (!api.current) return;
    const files = api.current.panels.flatMap((panel) => fileOf(panel.id) ?? []);
    standardLayout(api.current);
    for (const file of files) openFilePanel(api.current, file);
  }, []);
  const enlargeActive = useCallback(() => api.current && enlarge(api.current), []);
  useImperativeHandle(
    ref,
    () => ({ reset, enlarge: enlargeActive, popOut: () => api.current && popOutActive(api.current) }),
    [reset, enlargeActive],
  );

  const onReady = useCallback(
    (event: DockviewReadyEvent) => {
      const dock = event.api;
      api.current = dock;
      const keepLayout = () => begins === undefined && keep(LAYOUT, dock.toJSON());
      if (begins === undefined) restoreLayout(dock, recall<unknown>(LAYOUT, null));
      dock.onDidLayoutChange(keepLayout);
      dock.onDidActivePanelChange(({ panel }) => {
        keepLayout(); // which tab is in front is no change of the layout to the dock
        const path = panel && fileOf(panel.id);
        if (path) inFrontIs(path);
      });
      dock.onDidLayoutChange(() => tabs.current?.soon());
      dock.onDidActivePanelChange(() => tabs.current?.soon());
      widePanels(dock);
      dock.onDidRemovePanel((panel) => {
        const path = fileOf(panel.id);
        // Moving a panel removes it and adds it again, so a file is closed only if its panel is still missing afterwards.
        if (path) queueMicrotask(() => dock.getPanel(panel.id) ?? closeDocument(path));
      });
      onNavigate({
        file: (path) => openFilePanel(dock, path),
        panel: (name) => showFixedPanel(dock, name),
        page: (name) => openPagePanel(dock, name),
      });
      if (begins) beginWith(dock, begins.panel, begins.onTitle);
    },
    [begins],
  );

  useFilesOfProject(api, begins === undefined ? project : null);

  // A tab cannot contain a close button that the keyboard reaches; Delete closes the file or page instead. The key is handled here,
  // before the dock handles it: the dock knows neither the start page nor that a page may have the whole dock.
  function onKeyDown(event: KeyboardEvent): void {
    const tab = event.target instanceof HTMLElement ? event.target.closest(".dv-tab") : null;
    const panel = tab?.querySelector<HTMLElement>("[data-closes]")?.dataset.closes;
    if (!["Delete", "Backspace"].includes(event.key) || panel === undefined || !api.current) return;
    event.preventDefault();
    event.stopPropagation();
    const strip = tab?.parentElement;
    closeByHand(api.current, panel);
    strip?.querySelector<HTMLElement>(".dv-active-tab")?.focus();
  }

  /** The first click has made the tab the active one. */
  function onDoubleClick({ target }: MouseEvent): void {
    if (target instanceof HTMLElement && target.closest(".dv-tab") && !target.closest(".x")) enlargeActive();
  }

  return (
    <div ref={element} className="dock" onKeyDownCapture={onKeyDown} onDoubleClick={onDoubleClick}>
      <DockviewReact
        theme={THEME}
        components={components}
        defaultTabComponent={PanelTab}
        rightHeaderActionsComponent={HeaderEnd}
        disableFloatingGroups
        getAnnouncement={announcement}
        onReady={onReady}
      />
      <CloseUnsaved onClosed={(panel) => api.current && closeTab(api.current, panel)} />
    </div>
  );
}

const inFrontIs = (path: string) =>
  useDocuments.setState(({ active, cursor }) => ({ active: path, cursor: active === path ? cursor : null }));

/** On a change of project: closes the files of the old project and opens those of the new one. Deleted files are closed, too. */
function useFilesOfProject(api: { current: DockviewApi | null }, project: number | null): void {
  useEffect(() => {
    const dock = api.current;
    if (!dock || project === null) return;
    const kept = recall<{ project: number; files: string[] }>("files", { project, files: [] });
    const wanted = kept.project === project ? kept.files : recall<string[]>(`files.${project}`, []);
    const switched = kept.project !== project;
    closeFiles(dock, (path) => switched || !wanted.includes(path));
    // Files of the restored layout are there, each part of a split with its own tab in front.
    const shown = new Set(dock.panels.map((panel) => fileOf(panel.id)));
    for (const path of wanted) if (!shown.has(path)) openFilePanel(dock, path);
    const front = recall<string>(`front.${project}`, "");
    if (wanted.includes(front)) {
      if (switched) openFilePanel(dock, front);
      else offerFilePanel(dock, front);
      inFrontIs(front); // the dock tells nothing where it was in front already
    }
    const inFront = useDocuments.subscribe(({ active }, before) => {
      if (active !== null && active !== before.active) keep(`front.${project}`, active);
    });
    const remember = dock.onDidLayoutChange(() => {
      const files = dock.panels.flatMap((panel) => fileOf(panel.id) ?? []);
      keep("files", { project, files });
      keep(`files.${project}`, files);
    });
    const stop = useDocuments.subscribe((now, before) => {
      if (now.project !== project || now.files === before.files) return;
      const known = new Set(now.files.map((file) => file.path));
      closeFiles(dock, (path) => !known.has(path) && !holdsUnsaved(path));
      if (before.files.length === 0 && !dock.panels.some((panel) => fileOf(panel.id))) openFirst(dock, switched);
    });
    const pous = useDocuments.subscribe((now, before) => {
      if (before.pous.length === 0 && now.pous.length > 0 && !dock.panels.some((panel) => fileOf(panel.id)))
        openFirst(dock, switched);
    });
    return () => {
      inFront();
      remember.dispose();
      stop();
      pous();
    };
  }, [api, project]);
}

/** When a project is opened for the first time, its first program is opened; `front`: before the pages of the project before. */
function openFirst(dock: DockviewApi, front: boolean): void {
  const { pous, files } = useDocuments.getState();
  const first = pous.find((pou) => pou.kind === "program")?.file ?? (pous.length > 0 ? files[0]?.path : undefined);
  if (first) (front ? openFilePanel : offerFilePanel)(dock, first);
}
