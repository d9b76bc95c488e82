import { memo, useMemo } from "react";
import { allErrors, inNames } from "../../logic/catalogue";
import { grouped } from "../../logic/numbers";
import { t } from "../../logic/text";
import { type Axis, type Cluster, clusters, countKinds } from "../../logic/timeline";
import { useBench } from "../../store/bench";
import { usePlc } from "../../store/plc";
import { travel, useTimeline } from "../../store/timeline";
import { Icon, type IconName } from "../../ui/Icon";
import type { Mark } from "../../wire/types";

const LOOK: Record<Mark["kind"], { icon: IconName | null; tone: string }> = {
  write: { icon: null, tone: "cmd" },
  run: { icon: null, tone: "plain" },
  force: { icon: "forced", tone: "forced" },
  error: { icon: "generated", tone: "generated" },
  recover: { icon: "cleared", tone: "cleared" },
  mode: { icon: "swap", tone: "plain" },
  build: { icon: "init", tone: "plain" },
  system: { icon: "info", tone: "system" },
};

/** Room for an icon and a number of two digits with its plus. */
const APART = 42;

interface Props {
  axis: Axis;
  width: number;
  position: number;
}

/** What was done to the PLC, where it was done; what lies too close is one mark with a number. By keyboard: Ctrl with an arrow. */
export const Marks = memo(function Marks({ axis, width, position }: Props) {
  const marks = useTimeline((timeline) => timeline.marks);
  const found = useMemo(() => (width > 0 ? clusters(marks, axis, width, APART) : []), [marks, axis, width]);
  const model = useBench((bench) => bench.model);
  const errors = useMemo(() => allErrors(model?.catalogue ?? []), [model]);
  const you = usePlc((plc) => plc.you?.name);
  const say = (mark: Mark) =>
    t("timeline.mark", {
      kind: t(`log.kind.${mark.kind}`),
      text: mark.kind === "error" || mark.kind === "recover" ? inNames(errors, mark.text) : mark.text,
      scan: grouped(mark.scan),
      author: mark.author,
    });
  return (
    <ul className="tl-marks" aria-label={t("timeline.marks")}>
      {found.map((cluster) => (
        <li key={cluster.marks[0]?.scan} style={{ left: `${cluster.place * 100}%` }}>
          <MarkButton
            cluster={cluster}
            label={cluster.marks.length === 1 ? say(cluster.first) : sayMany(cluster, say(cluster.first))}
            you={cluster.first.author === you}
            later={cluster.first.scan > position}
          />
        </li>
      ))}
    </ul>
  );
});

function sayMany({ marks }: Cluster, first: string): string {
  const kinds = countKinds(marks)
    .map(([kind, count]) => `${t(`log.kind.${kind}`)} ${count}`)
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
}

function MarkButton({ cluster, label, you, later }: MarkProps) {
  const { icon, tone } = LOOK[cluster.first.kind];
  const many = cluster.marks.length > 1;
  return (
    <button
      type="button"
      className={`mk ${tone}${you ? " you" : ""}${later ? " later" : ""}`}
      tabIndex={-1}
      aria-label={label}
      title={label}
      onClick={() => void travel(cluster.first.scan)}
    >
      {icon ? <Icon name={icon} /> : <i />}
      {many && <span className="n">{cluster.marks.length > 99 ? "99+" : cluster.marks.length}</span>}
    </button>
  );
}
