import { memo, useMemo, useState } from "react";
import { inNames } from "../../../logic/errors/catalogue";
import { grouped } from "../../../logic/format/numbers";
import { type Axis, around, type Cluster, clusters, countKinds, type ShownMark } from "../../../logic/plc/timeline";
import { useCatalogue } from "../../../store/errors/catalogue";
import { usePlc } from "../../../store/plc/plc";
import { setView, travel } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { Menu, type MenuItem } from "../../../ui/Menu";
import { pointMenu } from "./menus";

const LOOK: Record<ShownMark["kind"], { icon: IconName | null; tone: string }> = {
  write: { icon: null, tone: "cmd" },
  run: { icon: null, tone: "plain" },
  force: { icon: "forced", tone: "forced" },
  error: { icon: "generated", tone: "generated" },
  recover: { icon: "cleared", tone: "cleared" },
  mode: { icon: "swap", tone: "plain" },
  build: { icon: "init", tone: "plain" },
  system: { icon: "info", tone: "system" },
  halt: { icon: "bp", tone: "brk" },
  disturbance: { icon: "disturbance", tone: "system" },
  difference: { icon: "differs", tone: "diff" },
};

/** Room for an icon and a number of two digits with its plus sign. */
const APART = 42;

const kindWord = (kind: ShownMark["kind"]) =>
  t(kind === "difference" ? "timeline.kind.difference" : `log.kind.${kind}`);

interface Props {
  /** In the order of their scans. */
  marks: readonly ShownMark[];
  axis: Axis;
  whole: Axis;
  width: number;
  position: number;
}

/** The commands of the PLC at their scans. Marks that are too close share one icon with a number; a click enlarges the group. By keyboard: Ctrl with an arrow. */
export const Marks = memo(function Marks({ marks, axis, whole, width, position }: Props) {
  const found = useMemo(() => (width > 0 ? clusters(marks, axis, width, APART) : []), [marks, axis, width]);
  const { errors } = useCatalogue();
  const you = usePlc((plc) => plc.you?.name);
  const [listed, setListed] = useState<{ items: MenuItem[]; at: { x: number; y: number } } | null>(null);
  const say = (mark: ShownMark) =>
    t("timeline.mark", {
      kind: kindWord(mark.kind),
      text: mark.kind === "error" || mark.kind === "recover" ? inNames(errors, mark.text) : mark.text,
      scan: grouped(mark.scan),
      author: mark.author,
    });

  /** A single mark: goes to its scan. A group: zooms in; if all its marks are at one scan, lists them. */
  function choose({ first, marks: group }: Cluster, button: HTMLElement): void {
    if (group.length === 1) {
      void travel(first.scan);
      return;
    }
    const closer = around(group, axis, whole);
    if (closer) {
      setView(closer, whole);
      return;
    }
    const { left, top } = button.getBoundingClientRect();
    const scanOf = new Map(group.map((mark) => [say(mark), mark.scan]));
    const items = [...scanOf].map(([label, scan]) => ({ label, onSelect: () => void travel(scan) }));
    setListed({ items, at: { x: left, y: top - 4 } });
  }

  /** Other actions for the scan: its errors can be replayed with a change. */
  function openMenu(cluster: Cluster, at: { x: number; y: number }): void {
    setListed({ items: pointMenu({ scan: cluster.first.scan, marks: cluster.marks, position }), at });
  }

  return (
    <ul className="tl-marks" aria-label={t("timeline.marks")}>
      {listed && <Menu label={t("timeline.marks")} {...listed} onClose={() => setListed(null)} />}
      {found.map((cluster) => (
        <li key={cluster.marks[0]?.scan} style={{ left: `${cluster.place * 100}%` }}>
          <MarkButton
            cluster={cluster}
            label={cluster.marks.length === 1 ? say(cluster.first) : sayMany(cluster, say(cluster.first))}
            you={cluster.first.author === you}
            later={cluster.first.scan > position}
            onChoose={(button) => choose(cluster, button)}
            onMenu={(at) => openMenu(cluster, at)}
          />
        </li>
      ))}
    </ul>
  );
});

function sayMany({ marks }: Cluster, first: string): string {
  const kinds = countKinds(marks)
    .map(([kind, count]) => `${kindWord(kind)} ${count}`)
    .join(", ");
  const scans = marks.map((mark) => mark.scan);
  return t("timeline.mark.many", {
    count: marks.length,
    from: grouped(Math.min(...scans)),
    to: grouped(Math.max(...scans)),
    kinds,
    first,
  });
}

interface MarkProps {
  cluster: Cluster;
  label: string;
  you: boolean;
  later: boolean;
  onChoose: (button: HTMLElement) => void;
  onMenu: (at: { x: number; y: number }) => void;
}

function MarkButton({ cluster, label, you, later, onChoose, onMenu }: MarkProps) {
  const { icon, tone } = LOOK[cluster.first.kind];
  const many = cluster.marks.length > 1;
  return (
    <button
      type="button"
      className={`mk ${tone}${you ? " you" : ""}${later ? " later" : ""}`}
      tabIndex={-1}
      aria-label={label}
      title={label}
      // While the run is short its marks move quickly: a press and its release belong to the same mark.
      onPointerDown={(event) => event.currentTarget.setPointerCapture?.(event.pointerId)}
      onClick={(event) => onChoose(event.currentTarget)}
      onContextMenu={(event) => {
        event.preventDefault();
        onMenu({ x: event.clientX, y: event.clientY });
      }}
    >
      {icon ? <Icon name={icon} /> : <i />}
      {many && <span className="n">{cluster.marks.length > 99 ? "99+" : cluster.marks.length}</span>}
    </button>
  );
}
