/** Menus of the timeline: for a scan, for the errors raised there, and for a stretch. */
import { grouped } from "../../../logic/format/numbers";
import { errorsIn } from "../../../logic/past/past";
import { type Axis, closeTo, type ShownMark } from "../../../logic/plc/timeline";
import { catalogueNow } from "../../../store/errors/catalogue";
import { showChanges } from "../../../store/past/changes";
import { showRerun } from "../../../store/past/reruns";
import { scanLink } from "../../../store/plc/links";
import { saveScenario, selectStretch, setView, travel } from "../../../store/plc/timeline";
import { verifyStretch } from "../../../store/verify/verify";
import { showWhatIf } from "../../../store/verify/whatif";
import { t } from "../../../text";
import { copyText } from "../../../ui/clipboard";
import type { MenuItem } from "../../../ui/Menu";

/** The menu of a stretch, both ends included. The changes of its last scan are visible only before the next scan. */
export function stretchMenu({ from, to }: Axis, whole: Axis): MenuItem[] {
  const scans = { first: grouped(from), last: grouped(to) };
  return [
    { label: t("stretch.verify", scans), icon: "differs", onSelect: () => verifyStretch(from, to) },
    {
      label: t("stretch.changes", scans),
      icon: "changed",
      onSelect: () => showChanges(from, Math.min(to + 1, whole.to)),
    },
    {
      label: t("stretch.zoom"),
      icon: "zoom-in",
      onSelect: () => setView(closeTo({ from, to }, whole), whole),
    },
    { label: t("stretch.clear"), icon: "x", hint: "Esc", onSelect: () => selectStretch(null) },
  ];
}

interface Point {
  scan: number;
  /** The marks at this scan. */
  marks: readonly ShownMark[];
  /** The scan that is shown now. */
  position: number;
}

/** The menu of a scan, and of the errors that were raised before it. */
export function pointMenu({ scan, marks, position }: Point): MenuItem[] {
  const since = { first: grouped(Math.min(scan, position)), last: grouped(Math.max(scan, position)) };
  return [
    { label: t("changes.goto", { scan: grouped(scan) }), icon: "moved", onSelect: () => void travel(scan) },
    ...(scan === position
      ? []
      : [{ label: t("stretch.since", since), icon: "changed" as const, onSelect: () => showChanges(scan, position) }]),
    {
      label: t("link.copy.scan", { scan: grouped(scan) }),
      icon: "link",
      onSelect: () => void copyText(scanLink(scan)),
    },
    {
      label: t("scenario.make", { scan: grouped(scan) }),
      icon: "export",
      onSelect: () => void saveScenario(scan),
    },
    { label: t("whatif.from", { scan: grouped(scan) }), icon: "branch", onSelect: () => showWhatIf(scan) },
    ...errorsOf(marks).flatMap((error, index, all) => replayItems(error, all.length > 1, index)),
  ];
}

interface Raised {
  scan: number;
  error: string;
}

/** The errors that marks say were raised, each once. */
function errorsOf(marks: readonly ShownMark[]): Raised[] {
  const { byId } = catalogueNow();
  const ids = new Set(byId.keys());
  const found = new Map<string, Raised>();
  for (const { kind, text, scan } of marks) {
    if (kind !== "error") continue;
    for (const error of errorsIn(text, ids)) found.set(`${scan} ${error}`, { scan, error });
  }
  return [...found.values()];
}

function replayItems(of: Raised, many: boolean, index: number): MenuItem[] {
  const name = catalogueNow().byId.get(of.error)?.name ?? of.error;
  const named = (label: string) => (many ? `${name} (${grouped(of.scan)}): ${label}` : label);
  return [
    {
      label: named(t("rerun.menu.instead")),
      icon: index === 0 ? "branch" : undefined,
      separated: true,
      onSelect: () => showRerun(of, { how: "instead" }),
    },
    { label: named(t("rerun.menu.earlier")), onSelect: () => showRerun(of, { by: -1 }) },
    { label: named(t("rerun.menu.later")), onSelect: () => showRerun(of, { by: 1 }) },
    { label: named(t("rerun.menu.out")), onSelect: () => showRerun(of, { how: "out" }) },
  ];
}
