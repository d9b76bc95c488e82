import { type CSSProperties, type KeyboardEvent, useEffect, useMemo, useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { splitPath } from "../../../logic/format/paths";
import { useWidths } from "../../../store/page/columns";
import { useForbidden } from "../../../store/plc/plc";
import { watch } from "../../../store/plc/watches";
import { addToTrace } from "../../../store/trace/added";
import { useForces, useForceValues } from "../../../store/watch/forces";
import { addToWatch, releaseForce, useWatchList } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { type MenuItem, useMenu } from "../../../ui/Menu";
import { useColumns } from "../../../ui/useColumns";
import { belowRow, useGrid } from "../../../ui/useGrid";
import type { ForceInfo } from "../../../wire/types";
import { NowCell } from "./NowCell";
import "./forces.css";

/** All active forces, whoever set them: the value before, the value of the program, the value at output; released one by one or all at once. */
export function ForcesPanel() {
  const held = useForces((forces) => forces.held);
  const forces = useMemo(() => [...new Set(held.values())], [held]);
  const locked = useForbidden("force");
  return (
    <div className="pane flexcol" data-pane="forces" data-live>
      {forces.length === 0 ? (
        <Empty
          title={t("forces.none")}
          about={t("forces.none.about")}
          ways={[
            { icon: "mouse", strong: t("watch.empty.click"), rest: t("forces.none.click") },
            { icon: "keyboard", strong: "F7", rest: t("forces.none.key") },
          ]}
        />
      ) : (
        <>
          <div className="sub">
            <span className="st forced">
              <Icon name="forced" small />
              {t("force.count", { count: forces.length })}
            </span>
            <span className="grow" />
            <button
              type="button"
              className="btn sm"
              disabled={locked !== null}
              title={locked ?? undefined}
              onClick={() => void releaseForce(null)}
            >
              <Icon name="unforce" small />
              {t("force.releaseall")}
            </button>
          </div>
          <ForceGrid forces={forces} />
        </>
      )}
    </div>
  );
}

const COLUMNS = ["value", "before", "program", "after", "now"] as const;

function ForceGrid({ forces }: { forces: readonly ForceInfo[] }) {
  const [selected, setSelected] = useState(0);
  const { open, menu } = useMenu();
  const grid = useGrid({ count: forces.length });
  const { style, grip, head } = useColumns(useWidths("forces"));
  const now = Math.min(selected, forces.length - 1);
  useEffect(() => watch(forces.map(({ path }) => path)), [forces]);

  function go(to: number): void {
    setSelected(grid.clamped(to));
    grid.reveal(grid.clamped(to));
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    const to = grid.stepOf(event.key, now);
    const force = forces[now];
    if (to !== undefined) go(to);
    else if (event.key === "Delete" || (event.key === "F7" && event.shiftKey)) void releaseForce(force?.path ?? null);
    else if (event.key === "ContextMenu" && force) open(forceMenu(force), belowRow(event.currentTarget));
    else return;
    event.preventDefault();
  }

  return (
    <div
      ref={grid.scroll}
      className="grid forces scroll"
      role="grid"
      aria-label={t("forces.label")}
      aria-rowcount={forces.length + 1}
      aria-activedescendant={grid.isDrawn(now) ? `force-${now}` : undefined}
      style={style}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className="gr h" role="row" aria-rowindex={1}>
        {head("variable", t("forces.variable"), "first")}
        {COLUMNS.map((column) => (
          <span
            key={column}
            className="num"
            role="columnheader"
            aria-label={t(`forces.${column}`)}
            title={t(`forces.${column}.about`)}
          >
            {t(`forces.${column}`)}
            {grip(column, t(`forces.${column}`))}
          </span>
        ))}
        {head("author", t("forces.author"))}
        <span className="num" role="columnheader">
          {t("forces.since")}
        </span>
        <span role="columnheader">
          <span className="unseen">{t("force.release")}</span>
        </span>
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const { index } = item;
          const force = forces[index];
          if (!force) return null;
          return (
            <ForceLine
              key={force.path}
              force={force}
              index={index}
              style={{ transform: `translateY(${grid.topOf(item)}px)` }}
              selected={index === now}
              onSelect={() => setSelected(index)}
              onMenu={(at) => open(forceMenu(force), at)}
            />
          );
        })}
      </div>
      {menu}
    </div>
  );
}

function forceMenu({ path }: ForceInfo): MenuItem[] {
  return [
    { label: t("force.release"), icon: "unforce", hint: "Del", onSelect: () => void releaseForce(path) },
    { label: t("watch.addone"), icon: "eye", onSelect: () => addToWatch([path]) },
    { label: t("watch.totrace"), icon: "trigger", onSelect: () => void addToTrace(path) },
  ];
}

interface LineProps {
  force: ForceInfo;
  index: number;
  style: CSSProperties;
  selected: boolean;
  onSelect: () => void;
  onMenu: (at: { x: number; y: number }) => void;
}

function ForceLine({ force, index, style, selected, onSelect, onMenu }: LineProps) {
  const { path, value, author, through, scan } = force;
  const { own, name } = splitPath(path);
  const locked = useForbidden("force");
  const did = useForceValues((values) => values.of.get(path)) ?? force;
  const refused = useWatchList((list) => list.notes.get(path)?.message);
  return (
    <div
      id={`force-${index}`}
      className={`gr${selected ? " on" : ""}`}
      role="row"
      style={style}
      aria-rowindex={index + 2}
      aria-selected={selected}
      data-force={path}
      onClick={onSelect}
      onContextMenu={(event) => {
        event.preventDefault();
        onSelect();
        onMenu({ x: event.clientX, y: event.clientY });
      }}
    >
      <span
        className="name"
        role="gridcell"
        title={[path, through && t("forces.through", { through }), refused].filter(Boolean).join("\n")}
      >
        <span className="st forced">
          <Icon name="forced" small />
        </span>
        <span className="path">
          <span className="own">{own}</span>
          <span className="last">{name}</span>
          {through && <span className="ui faint"> {t("forces.through", { through })}</span>}
        </span>
      </span>
      <Text text={value} strong />
      <Text text={did.before} />
      <Text text={did.after_program} differs={did.after_program !== did.after} />
      <Text text={did.after} />
      <NowCell path={path} />
      <span role="gridcell" title={author}>
        {author}
      </span>
      <span className="num" role="gridcell">
        {grouped(scan)}
      </span>
      <span className="end" role="gridcell">
        <IconButton
          icon="unforce"
          small
          label={locked ?? t("force.release.path", { path })}
          disabled={locked !== null}
          onClick={() => void releaseForce(path)}
        />
      </span>
    </div>
  );
}

function Text({ text, strong, differs }: { text: string; strong?: boolean; differs?: boolean }) {
  const look = strong ? " forcedvalue" : differs ? " differs" : "";
  return (
    <span className={`num${look}`} role="gridcell" title={text}>
      {differs && <Icon name="differs" small />}
      {text || "–"}
    </span>
  );
}
