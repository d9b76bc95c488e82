import { bytes, duration, grouped } from "../../../logic/format/numbers";
import { zoomed } from "../../../logic/plc/timeline";
import { setView, useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { MenuButton } from "../../../ui/Menu";
import type { TimelineInfo } from "../../../wire/types";
import { stretchMenu } from "./menus";
import type { RunOnAxis } from "./useRun";

const STEP = 4;

/** The left end: the length and the size of the run, which part is slower to reach or gone; zoom buttons. */
export function Facts({ run, interval }: { run: RunOnAxis | null; interval: number }) {
  const info = useTimeline((timeline) => timeline.info);
  const view = useTimeline((timeline) => timeline.view);
  const selection = useTimeline((timeline) => timeline.selection);

  function zoom(factor: number): void {
    if (!run) return;
    const { axis, whole, position } = run;
    // Zooming keeps the playhead in place only while it is visible.
    const held = position >= axis.from && position <= axis.to ? position : (axis.from + axis.to) / 2;
    setView(zoomed(axis, whole, factor, held), whole);
  }

  const scans = run ? run.whole.to - run.whole.from : 0;
  return (
    <div className="tl-info">
      <div className="row tight">
        <h2 className="grow">{t("timeline.label")}</h2>
        {run && selection && (
          <MenuButton
            label={t("stretch.menu", { first: grouped(selection.from), last: grouped(selection.to) })}
            className="ib sm"
            items={() => stretchMenu(selection, run.whole)}
          >
            <Icon name="more" />
          </MenuButton>
        )}
        <IconButton
          icon="zoom-out"
          label={t("timeline.zoom.out")}
          small
          disabled={view === null}
          onClick={() => zoom(STEP)}
        />
        <IconButton
          icon="zoom-in"
          label={t("timeline.zoom.in")}
          small
          disabled={scans < 40}
          onClick={() => zoom(1 / STEP)}
        />
        <IconButton
          icon="fit"
          label={t("timeline.all")}
          small
          disabled={view === null}
          onClick={() => run && setView(null, run.whole)}
        />
      </div>
      {run && (
        <span className="hint cut" role="status" title={t("stretch.hint")}>
          {selection
            ? t("stretch.selected", { first: grouped(selection.from), last: grouped(selection.to) })
            : t("timeline.length", { scans: grouped(scans), time: duration(scans * interval) })}
        </span>
      )}
      {info && <RunFile info={info} />}
    </div>
  );
}

function RunFile({ info }: { info: TimelineInfo }) {
  const { dropped_before: dropped, thinned_before: thinned, lost: gaps = [] } = info;
  const said = t("timeline.bound", { bytes: bytes(info.bytes), limit: bytes(info.limit_bytes) });
  const [gap] = gaps.map(({ first, until }) => ({ first: grouped(first), last: grouped(Math.max(first, until - 1)) }));
  const lost = [
    gap ? t("timeline.lost", gap) : "",
    dropped > 0 ? t("timeline.dropped", { scan: grouped(dropped) }) : "",
    thinned > 0 ? t("timeline.thinned", { scan: grouped(thinned) }) : "",
  ].filter(Boolean);
  const short = gap
    ? t("timeline.lost.short", gap)
    : dropped > 0
      ? t("timeline.dropped.short", { scan: grouped(dropped) })
      : thinned > 0
        ? t("timeline.thinned.short", { scan: grouped(thinned) })
        : "";
  return (
    <span className="hint row tight apart tl-file" title={[said, t("timeline.file.about"), ...lost].join("\n")}>
      <span className="cut">{short === "" ? said : bytes(info.bytes)}</span>
      {short !== "" && (
        <span className="st warning">
          <Icon name="past" small />
          {short}
        </span>
      )}
      <span className="sr"> {lost.join(" ")}</span>
    </span>
  );
}
