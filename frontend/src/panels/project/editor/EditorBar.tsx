import { useState } from "react";
import { pouAt } from "../../../logic/plc/sourceLines";
import { builtNote, changeNote } from "../../../logic/project/change";
import { rollBack } from "../../../store/debug/run";
import { drawnKind, showAs, useViewOf } from "../../../store/graphic/views";
import { showPanel } from "../../../store/page/navigate";
import { toggleChecks, toggleFormatOnType, toggleLenses, usePrefs } from "../../../store/page/prefs";
import { useBench } from "../../../store/plc/bench";
import { useForbidden, useLost, usePlc } from "../../../store/plc/plc";
import { build, isDirty, save, useDocuments } from "../../../store/project/documents";
import { useCorrected } from "../../../store/project/refusedBuild";
import { shownText, useShownProgram, useShowsRan } from "../../../store/project/shownProgram";
import { useUnsavedOfOthers } from "../../../store/project/unsaved";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { Segments } from "../../../ui/Segments";
import { StateWord } from "../../../ui/StateWord";
import type { Pou } from "../../../wire/types";
import { DebugSwitches, useSwitches } from "./DebugSwitches";
import { shownLine, useHaltedLine } from "./halt";
import { SeenAs } from "./SeenAs";
import { canVerify, VerifyButton } from "./VerifyButton";
import { verifyHere } from "./verifyHere";

const VIEWS = ["graphic", "text", "both"] as const;

/** Kinds of declarations with instances: the text shows the values of one instance. */
const INSTANCED: readonly Pou["kind"][] = ["program", "function_block", "class"];

/** The bar above the text: the declaration, the result of the last build, Save and Build. */
export function EditorBar({ path }: { path: string }) {
  useDocuments((documents) => documents.pous);
  useShownProgram();
  const ran = useShowsRan(path);
  const cursor = useDocuments((documents) => (documents.active === path ? documents.cursor : null));
  const dirty = useDocuments((documents) => isDirty(documents.open[path]));
  const building = useDocuments((documents) => documents.build.phase === "running");
  const lost = useLost();
  const forbidden = useForbidden("build");
  const unbuildable = lost ? t("lost.nobuild") : forbidden;
  // Not a subscription: the caret moves with every change of the text.
  const { text, pous } = shownText(path);
  const line = useLooked(path, cursor);
  const found = pouAt(pous, path, line, text) ?? firstOf(pous, path);
  // A global variable is only one line of the file, so it is not shown as the file's declaration.
  const pou = found?.kind === "global" ? { name: path, kind: found.kind } : found;
  return (
    <div className="edbar">
      <div className="sub edrow">
        <span className="edinfo">
          <span className="cut">{pou?.name ?? path}</span>
          {pou && INSTANCED.includes(pou.kind) ? (
            <SeenAs pou={pou.name} />
          ) : (
            pou && <span className="faint cut">{t(`kind.${pou.kind}`)}</span>
          )}
          <BuildOutcome />
        </span>
        <span className="edtools">
          {drawnKind(text) && <ViewChoice path={path} text={text} />}
          <span className="edextra">
            <RollBack />
          </span>
          <DebugSwitches path={path} />
          <span className="edextra">
            <VerifyButton path={path} pou={found} />
            <ChecksToggle />
          </span>
          <More path={path} pou={found} />
          <button
            type="button"
            className="btn quiet sm"
            disabled={!dirty || lost || ran}
            title={lost ? t("lost.nosave") : ran ? t("past.text.unsaved") : t("save.hint")}
            onClick={() => void save(path)}
          >
            {t("save")}
          </button>
          <button
            type="button"
            className="btn sm"
            disabled={building || unbuildable !== null}
            title={unbuildable ?? t("build.hint")}
            onClick={() => void build()}
          >
            <Icon name="play" small />
            {building ? t("building") : t("build")}
          </button>
        </span>
      </div>
    </div>
  );
}

/** The drawing of what a file has of ladders and charts, the text, or both. */
function ViewChoice({ path, text }: { path: string; text: string }) {
  const view = useViewOf(path, text);
  const drawing = t(`graphic.view.${drawnKind(text) ?? "mixed"}`);
  return (
    <Segments
      label={t("graphic.view")}
      value={view}
      options={VIEWS.map((value) => ({ value, word: value === "graphic" ? drawing : t(`graphic.view.${value}`) }))}
      onChoose={(chosen) => showAs(path, chosen)}
    />
  );
}

/** The first declaration of a file: the bar shows it for the lines before it, too. */
const firstOf = (pous: readonly Pou[], path: string) =>
  pous.filter(({ file }) => file === path).sort((a, b) => a.line - b.line)[0];

type Cursor = NonNullable<ReturnType<typeof useDocuments.getState>["cursor"]>;

/** The line that the bar is about: the line of the halt, until the user moves the caret. */
function useLooked(path: string, cursor: Cursor | null): number {
  const halted = useHaltedLine(path);
  const key = halted?.key ?? "";
  const [since, setSince] = useState({ key, cursor });
  if (since.key !== key || (since.cursor === null && cursor !== null)) setSince({ key, cursor });
  const moved = since.key === key && since.cursor !== null && cursor !== null && since.cursor.line !== cursor.line;
  return halted && !moved ? shownLine(path, halted.line) : (cursor?.line ?? 1);
}

/** What is done less often than to save and to build, which stay where they are; in a narrow bar also what has no room there. */
function More({ path, pou }: { path: string; pou: Pou | undefined }) {
  const note = useChangeNote();
  const forbidden = useForbidden("change");
  const { checks, formatOnType, lenses } = usePrefs();
  const running = useBench((bench) => bench.instance !== null);
  const switches = useSwitches();
  const items = (): MenuItem[] => [
    ...(running && pou && canVerify(pou)
      ? [{ label: t("verify.range.menu"), icon: "differs" as const, onSelect: () => verifyHere(path) }]
      : []),
    ...(drawnKind(shownText(path).text) ? switches : []),
    { label: t("checks.show"), checked: checks, onSelect: toggleChecks },
    { label: t("editor.lenses"), checked: lenses, onSelect: toggleLenses },
    { label: t("editor.formatontype"), checked: formatOnType, onSelect: toggleFormatOnType },
    ...(note === ""
      ? []
      : [
          {
            label: t("change.rollback"),
            icon: "past" as const,
            disabled: forbidden !== null,
            onSelect: () => void rollBack(),
          },
        ]),
  ];
  return (
    <span className="edmore">
      <MenuButton label={t("menu.label")} className="ib sm" items={items}>
        <Icon name="more" />
      </MenuButton>
    </span>
  );
}

function ChecksToggle() {
  const shown = usePrefs((prefs) => prefs.checks);
  return (
    <button
      type="button"
      className={`btn quiet sm${shown ? " on" : ""}`}
      aria-pressed={shown}
      aria-label={t("checks.show")}
      title={t("checks.hint")}
      onClick={toggleChecks}
    >
      {t("checks.short")}
    </button>
  );
}

/** The note about the last online change of this PLC; empty when there was none. */
function useChangeNote(): string {
  const instance = useBench((bench) => bench.instance?.id);
  const change = useDocuments((documents) => documents.change?.find((known) => known.instance === instance));
  if (change?.refusal !== "") return "";
  return changeNote(change);
}

/** A button beside the result of a build while an online change can be rolled back. */
function RollBack() {
  const note = useChangeNote();
  const forbidden = useForbidden("change");
  if (note === "") return null;
  return (
    <button
      type="button"
      className="btn quiet sm"
      disabled={forbidden !== null}
      title={forbidden ?? t("change.rollback.hint", { note })}
      aria-label={t("change.rollback")}
      onClick={() => void rollBack()}
    >
      <Icon name="past" small />
      <span className="wide-only">{t("change.rollback")}</span>
    </button>
  );
}

/** The PLC runs a different version than the last build: it was rolled back, or not changed. */
function OtherVersion() {
  const text = useBench((bench) => bench.project?.version);
  const runs = usePlc(({ state }) => (state && !state.past && state.state !== "off" ? state.program_version : 0));
  const building = useDocuments((documents) => documents.build.phase === "running");
  if (building || !text || !runs || runs === text) return null;
  return (
    <span className="cut" role="status" title={t("change.runs.hint", { text })}>
      <StateWord tone="warning" icon="warning" word={t("change.runs", { runs, text })} />
    </span>
  );
}

function BuildOutcome() {
  const state = useDocuments((documents) => documents.build);
  const here = useBench((bench) => bench.instance?.id);
  const corrected = useCorrected();
  const edited = useDocuments((documents) => Object.values(documents.open).some(isDirty));
  const others = useUnsavedOfOthers();
  if (state.phase !== "done" || corrected || (state.ok && edited)) return <OtherVersion />;
  const by = state.author ? t("build.by", { author: state.author }) : "";
  return (
    <button
      type="button"
      className="link plain cut"
      title={
        others.length > 0
          ? `${state.message}\n${t("build.unsaved.about", { files: others.join(", ") })}`
          : state.message
      }
      role="status"
      onClick={() => showPanel("problems")}
    >
      {state.ok && others.length > 0 ? (
        <StateWord
          tone="warning"
          icon="warning"
          word={`${builtNote(state.changes, here)}${by}, ${t("build.unsaved", { count: others.length })}`}
        />
      ) : state.ok ? (
        <StateWord tone="running" icon="check" word={`${builtNote(state.changes, here)}${by}`} />
      ) : (
        <StateWord tone="fatal" icon="error" word={`${t("build.refused")}${by}`} />
      )}
    </button>
  );
}
