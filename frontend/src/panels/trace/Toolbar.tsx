import { type RefObject, useState } from "react";
import { dayTime, grouped } from "../../logic/format/numbers";
import { zoomedAt } from "../../logic/trace/plots";
import { decode } from "../../logic/trace/samples";
import {
  change,
  choose,
  compare,
  deleteShown,
  drive,
  exportCsv,
  follow,
  isRecording,
  keepShown,
  look,
  newTrace,
  readSamples,
  type Shown,
  useTraces,
  viewOf,
  wholeOf,
} from "../../store/trace/traces";
import { t } from "../../text";
import { AskName } from "../../ui/AskName";
import { Icon, type IconName } from "../../ui/Icon";
import { IconButton } from "../../ui/IconButton";
import { MenuButton, type MenuItem } from "../../ui/Menu";
import type { TraceInfo, TraceRecordInfo } from "../../wire/types";
import { savePng } from "./png";
import { RetrospectiveDialog } from "./RetrospectiveDialog";

type Question = "keep" | "rename" | "retrospective" | null;
const COMPARED_POINTS = 8000;

/** The name and the state of the trace; zoom, files, and other actions. */
export function Toolbar({ shown, graph }: { shown: Shown | null; graph: RefObject<HTMLDivElement | null> }) {
  const [asked, ask] = useState<Question>(null);
  const follows = useTraces((traces) => traces.follows);
  const zoom = (factor: number) => {
    if (!shown) return;
    const view = viewOf(useTraces.getState(), shown);
    const held = useTraces.getState().follows ? view.to : (view.from + view.to) / 2;
    look(zoomedAt(view, wholeOf(shown), factor, held));
  };
  return (
    <div className="sub hbar" role="toolbar" aria-label={t("panel.trace")}>
      <SourceMenu shown={shown} onAsk={ask} />
      {shown && (
        <>
          <span className="vr" />
          <StateOf shown={shown} />
          <span className="grow" />
          <CompareMenu shown={shown} />
          <MenuButton
            label={t("trace.export")}
            items={() => [
              { label: t("trace.csv"), icon: "export", onSelect: () => void exportCsv() },
              {
                label: t("trace.png"),
                icon: "export",
                onSelect: () => graph.current && savePng(graph.current, shown.name),
              },
              ...(shown.trace
                ? [{ label: t("trace.keep"), icon: "record" as const, onSelect: () => ask("keep" as const) }]
                : []),
            ]}
          >
            <Icon name="export" small />
            <span className="long">CSV, PNG</span>
          </MenuButton>
          <span className="vr" />
          <IconButton icon="zoom-out" small label={t("timeline.zoom.out")} onClick={() => zoom(2)} />
          <IconButton icon="zoom-in" small label={t("timeline.zoom.in")} onClick={() => zoom(0.5)} />
          <IconButton icon="fit" small label={t("trace.fit")} onClick={() => look(null)} />
          {isRecording(shown.trace) && (
            <button
              type="button"
              className="btn quiet sm"
              aria-pressed={follows}
              title={t("trace.follow.hint")}
              onClick={() => (follows ? look(viewOf(useTraces.getState(), shown)) : follow())}
            >
              {t("trace.follow")}
            </button>
          )}
          {shown.trace && <DriveButton trace={shown.trace} />}
        </>
      )}
      {asked === "retrospective" && <RetrospectiveDialog onClose={() => ask(null)} />}
      {asked === "keep" && shown && (
        <AskName
          title={t("trace.keep.title")}
          about={t("trace.keep.about")}
          label={t("trace.keep.label")}
          action={t("trace.keep.do")}
          initial={shown.name}
          onName={keepShown}
          onClose={() => ask(null)}
        />
      )}
      {asked === "rename" && shown && (
        <AskName
          title={t("trace.rename")}
          label={t("trace.keep.label")}
          action={t("trace.rename")}
          initial={shown.name}
          onName={async (name) => void (await change({ name }))}
          onClose={() => ask(null)}
        />
      )}
    </div>
  );
}

function SourceMenu({ shown, onAsk }: { shown: Shown | null; onAsk: (question: Question) => void }) {
  const items = (): MenuItem[] => {
    const { traces, records, source } = useTraces.getState();
    const is = (kind: "trace" | "record", id: number) => source?.kind === kind && source.id === id;
    const listed = (record: TraceRecordInfo): MenuItem => ({
      label: `${record.name} (${record.instance}, ${dayTime(record.at)})`,
      checked: is("record", record.id),
      onSelect: () => choose({ kind: "record", id: record.id }),
    });
    const signals = shown?.signals.map(({ text }) => text) ?? [];
    const more: MenuItem[] = [
      ...(signals.length > 0
        ? [{ label: t("trace.new"), icon: "plus" as const, separated: true, onSelect: () => void newTrace(signals) }]
        : []),
      { label: t("trace.retrospective.menu"), icon: "past", onSelect: () => onAsk("retrospective") },
    ];
    if (shown?.trace) more.push({ label: `${t("trace.rename")}...`, onSelect: () => onAsk("rename") });
    if (shown)
      more.push({ label: t("trace.delete", { name: shown.name }), icon: "trash", onSelect: () => void deleteShown() });
    return [
      ...traces.map(({ id, definition, by }) => ({
        label: definition.name,
        hint: by,
        checked: is("trace", id),
        onSelect: () => choose({ kind: "trace", id }),
      })),
      ...records.slice(0, 20).map((record, at) => ({ ...listed(record), separated: at === 0 && traces.length > 0 })),
      ...more,
    ];
  };
  return (
    <MenuButton label={t("trace.choose")} items={items}>
      <Icon name="list" small />
      <span className="cut trname">{shown?.name ?? t("trace.none")}</span>
      {shown && <span className="faint">{shown.record ? t("trace.record") : t("trace.shared")}</span>}
      <Icon name="chev-d" small />
    </MenuButton>
  );
}

const STATES: Record<TraceInfo["state"], [string, IconName]> = {
  recording: ["running", "running"],
  armed: ["halted", "wait"],
  triggered: ["info", "trigger"],
  complete: ["info", "trigger"],
  stopped: ["stopped", "stopped"],
};

function StateOf({ shown: { trace, record, triggered, first, end } }: { shown: Shown }) {
  if (!trace) {
    return (
      <span className="faint cut">
        {t(record?.origin === "retrospective" ? "trace.of.retrospective" : "trace.of.trace", {
          first: grouped(first),
          last: grouped(Math.max(first, end - 1)),
          by: record?.by ?? "",
        })}
      </span>
    );
  }
  const [tone, icon] = STATES[trace.state];
  const { definition, note, hits } = trace;
  const what = definition.trigger && `${definition.trigger.text} ${t(`trace.when.${definition.trigger.when}`)}`;
  const facts =
    triggered !== null
      ? t("trace.triggered.at", { scan: grouped(triggered), what: what ?? "" })
      : trace.state === "armed"
        ? t("trace.waits", { what: what ?? "" })
        : trace.rows > 0
          ? t("trace.rows", { rows: grouped(trace.rows) })
          : "";
  return (
    <>
      <span className={`st ${tone}`} data-state={trace.state}>
        <Icon name={icon} small />
        {t(`trace.state.${trace.state}`)}
      </span>
      <span className="faint cut" title={note || facts}>
        {facts}
        {definition.repeat && hits > 0 ? `, ${t("trace.hits", { hits })}` : ""}
        {note && <span className="st halted"> {note}</span>}
      </span>
    </>
  );
}

function CompareMenu({ shown }: { shown: Shown }) {
  const compared = useTraces((traces) => traces.compared);
  const items = (): MenuItem[] => {
    const others = useTraces.getState().records.filter(({ id }) => shown.record?.id !== id);
    const one = async (record: TraceRecordInfo) => {
      const data = await readSamples({ kind: "record", id: record.id }, 0, null, COMPARED_POINTS);
      if (data) await compare(record, decode(data, record.signals));
    };
    if (others.length === 0) return [{ label: t("trace.compare.none"), disabled: true, onSelect: () => undefined }];
    return [
      { label: t("trace.compare.nothing"), checked: compared === null, onSelect: () => void compare(null, null) },
      ...others.slice(0, 20).map((record) => ({
        label: record.name,
        hint: dayTime(record.at),
        checked: compared?.record.id === record.id,
        onSelect: () => void one(record),
      })),
    ];
  };
  return (
    <MenuButton label={t("trace.compare")} items={items}>
      <Icon name="swap" small />
      <span className={compared ? "cut trname" : "long"}>
        {compared
          ? t(compared.by === "trigger" ? "trace.compared.trigger" : "trace.compared.first", {
              name: compared.record.name,
            })
          : t("trace.compare")}
      </span>
    </MenuButton>
  );
}

function DriveButton({ trace }: { trace: TraceInfo }) {
  const triggered = trace.definition.trigger !== null;
  if (isRecording(trace)) {
    return (
      <button type="button" className="btn sm" onClick={() => void drive("stop")}>
        <Icon name="pause" small />
        {t("trace.stop")}
      </button>
    );
  }
  return (
    <button type="button" className="btn sm" onClick={() => void drive("start")}>
      <Icon name={triggered ? "trigger" : "record"} small />
      {triggered ? t(trace.state === "complete" ? "trace.armagain" : "trace.arm") : t("trace.start")}
    </button>
  );
}
