import { useState } from "react";
import { stateWord, UNGRADED, VERDICTS } from "../../../logic/errors/sweep";
import { dayTime, percent } from "../../../logic/format/numbers";
import { compareSweeps, deleteSweep, keepState, openSweep, showSweep } from "../../../store/errors/sweeps";
import { useWidths } from "../../../store/page/columns";
import { useBench } from "../../../store/plc/bench";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { Menu } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";
import { VERDICT_ICONS } from "../../../ui/statuses";
import { useColumns } from "../../../ui/useColumns";
import type { SweepSummary } from "../../../wire/types";
import { NoSweeps } from "./NoSweeps";
import { States } from "./States";
import { STATUS } from "./statusWords";

/** Every sweep of the project, the newest first, and the kept states. */
export function SweepList({ list }: { list: readonly SweepSummary[] }) {
  const instance = useBench((bench) => bench.instance);
  const { style, head } = useColumns(useWidths("sweeps"));
  const [doomed, setDoomed] = useState<SweepSummary | null>(null);
  const [menu, setMenu] = useState<{ of: SweepSummary; at: { x: number; y: number } } | null>(null);
  return (
    <>
      <div className="sub tall">
        <h2 className="swtitle">{t("sweep.tab.list")}</h2>
        <span className="grow" />
        <button
          type="button"
          className="btn sm"
          disabled={!instance}
          title={t("states.keep.hint")}
          onClick={() => keepState()}
        >
          <Icon name="plus" small />
          {t("states.keep")}
        </button>
        <button
          type="button"
          className="btn primary sm"
          disabled={!instance}
          title={instance ? t("sweep.run.hint") : t("sweep.noplc")}
          onClick={openSweep}
        >
          {t("sweep.run.button")}
        </button>
      </div>
      <div className="scroll">
        {list.length === 0 ? (
          <NoSweeps />
        ) : (
          <div className="grid swlist" role="table" aria-label={t("sweep.tab.list")} style={style}>
            <div className="gr h" role="row">
              {(["at", "by", "of", "version", "status"] as const).map((column) =>
                head(column, t(`sweep.column.${column}`), `c-${column}`),
              )}
              <span role="columnheader" className="c-counts">
                {t("sweep.column.counts")}
              </span>
              <span role="columnheader">
                <span className="sr">{t("menu.label")}</span>
              </span>
            </div>
            {list.map((sweep) => (
              <Line key={sweep.id} sweep={sweep} onMenu={(at) => setMenu({ of: sweep, at })} />
            ))}
          </div>
        )}
        <States />
      </div>
      {menu && <LineMenu {...menu} list={list} onDelete={setDoomed} onClose={() => setMenu(null)} />}
      {doomed && (
        <Confirm
          title={t("sweep.delete.title", { at: dayTime(doomed.at) })}
          about={t("sweep.delete.about")}
          hint={t(doomed.status === "running" ? "sweep.delete.running" : "sweep.delete.hint")}
          verb={t("sweep.delete.do")}
          onDo={() => deleteSweep(doomed.id)}
          onClose={() => setDoomed(null)}
        />
      )}
    </>
  );
}

function Line({ sweep, onMenu }: { sweep: SweepSummary; onMenu: (at: { x: number; y: number }) => void }) {
  const { id, at, by, instance, model, program_version: version, status, done, total, states } = sweep;
  const you = usePlc((plc) => plc.you?.name);
  const share = total === 0 ? "" : percent(Math.floor((done / total) * 100));
  const running = status === "running";
  const word = running ? t("sweep.status.running.share", { share }) : t(`sweep.status.${status}`);
  return (
    <div
      className="gr"
      role="row"
      data-sweep={id}
      onContextMenu={(event) => {
        event.preventDefault();
        onMenu({ x: event.clientX, y: event.clientY });
      }}
    >
      <span role="cell" className="cut">
        <button type="button" className="link" onClick={() => showSweep(id)}>
          {dayTime(at)}
        </button>
      </span>
      <span role="cell" className="cut muted" title={by}>
        {by === you ? t("people.you", { name: by }) : by}
      </span>
      <span role="cell" className="cut muted c-of" title={`${instance}, ${model}`}>
        {instance} · {model}
      </span>
      <span role="cell" className="num">
        {version}
      </span>
      <span role="cell" title={sweep.message || undefined}>
        <StateWord {...STATUS[status]} word={word} />
      </span>
      <span
        role="cell"
        className="swsum"
        title={t("sweep.column.counts.about", { done, total, states: states.map(stateWord).join(", ") })}
      >
        {[...VERDICTS, ...UNGRADED]
          .filter((verdict) => sweep.counts[verdict])
          .map((verdict) => (
            <span key={verdict} className={`st ${verdict}`} title={t(`sweep.count.${verdict}`)}>
              <Icon name={VERDICT_ICONS[verdict]} small />
              {sweep.counts[verdict] ?? 0}
              <span className="word"> {t(`verdict.${verdict}`)}</span>
            </span>
          ))}
        <span className="faint cut">{t("sweep.runs", { done, total })}</span>
      </span>
      <span role="cell" className="gut end">
        <IconButton
          icon="more"
          small
          label={t("sweep.menu", { at: dayTime(at) })}
          onClick={() => {
            const button = document.activeElement?.getBoundingClientRect();
            onMenu({ x: button?.left ?? 0, y: (button?.bottom ?? 0) + 4 });
          }}
        />
      </span>
    </div>
  );
}

interface MenuProps {
  of: SweepSummary;
  at: { x: number; y: number };
  list: readonly SweepSummary[];
  onDelete: (sweep: SweepSummary) => void;
  onClose: () => void;
}

function LineMenu({ of, at, list, onDelete, onClose }: MenuProps) {
  const others = list.filter(({ id, done }) => id !== of.id && done > 0);
  return (
    <Menu
      label={t("sweep.menu", { at: dayTime(of.at) })}
      at={at}
      onClose={onClose}
      items={[
        { label: t("open"), icon: "generated", onSelect: () => showSweep(of.id) },
        ...others.map((other, index) => ({
          label: t("sweep.compare.menu", { at: dayTime(other.at), version: other.program_version }),
          icon: "swap" as const,
          separated: index === 0,
          onSelect: () => compareSweeps(of.id, other.id),
        })),
        { label: t("sweep.delete.menu"), icon: "trash", separated: true, onSelect: () => onDelete(of) },
      ]}
    />
  );
}
