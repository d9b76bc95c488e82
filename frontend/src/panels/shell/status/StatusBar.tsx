import { clockTime, dayTime, interval, isToday, percent } from "../../../logic/format/numbers";
import { useDebug } from "../../../store/debug/debug";
import { speedName, useRun } from "../../../store/debug/run";
import { showSweep, useSweeps } from "../../../store/errors/sweeps";
import { showPanel } from "../../../store/page/navigate";
import { chooseLanguage, usePrefs } from "../../../store/page/prefs";
import { useOnline, usePlc } from "../../../store/plc/plc";
import { useTimeline } from "../../../store/plc/timeline";
import { type Document, isDirty, useDocuments } from "../../../store/project/documents";
import { showAdded, useAdded } from "../../../store/trace/added";
import { languageNames, languages, t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";

/** The strip along the bottom: the connection and other general facts. */
export function StatusBar() {
  const online = useOnline();
  const state = usePlc((plc) => plc.state);
  return (
    <footer className="status" data-pane="status" data-live>
      {online ? (
        <span>
          <Icon name="check" />
          {t("status.connected")}
        </span>
      ) : (
        <StateWord tone="stale" icon="lost" word={t("status.notconnected")} />
      )}
      {state && (
        <span>{t("status.task", { interval: interval(state.interval_ns), speed: speedName(state.speed) })}</span>
      )}
      {state && (
        <span title={t("status.process", { pid: state.pid ?? "–" })}>
          {t("status.program", { version: state.program_version })}
        </span>
      )}
      {state && state.flavour !== "" && <span title={t("status.flavour.hint")}>{t("status.flavour", state)}</span>}
      {state !== null && state.restarts > 0 && <span>{t("status.restarts", { count: state.restarts })}</span>}
      {state !== null && state.forces > 0 && (
        <StateWord tone="forced" icon="forced" word={t("force.count", { count: state.forces })} />
      )}
      <Raised />
      <Sweeping />
      <ArmedFaults />
      <Added />
      <MadeTest />
      <RunRefusal />
      <span className="right">
        <FileState />
      </span>
      <Language />
    </footer>
  );
}

function Raised() {
  const errors = usePlc((plc) => plc.errors);
  const raised = [...errors.values()].filter((row) => row.status === "generated");
  if (raised.length === 0) return null;
  const fatal = raised.some((row) => row.severity === "fatal");
  return (
    <button type="button" className="link plain" onClick={() => showPanel("errors")}>
      <StateWord
        tone={fatal ? "fatal" : "generated"}
        icon={fatal ? "fatal" : "generated"}
        word={t("status.errors", { count: raised.length })}
      />
    </button>
  );
}

function ArmedFaults() {
  const count = usePlc((plc) => plc.armed.length);
  if (count === 0) return null;
  return (
    <button type="button" className="link plain" onClick={() => showPanel("errors")}>
      <StateWord tone="recording" icon="clock" word={t("armed.count", { count })} />
    </button>
  );
}

/** A running sweep, whoever began it; a click opens it. */
function Sweeping() {
  const sweep = useSweeps((sweeps) => sweeps.list?.find(({ status }) => status === "running"));
  if (!sweep) return null;
  const { id, by, done, total } = sweep;
  const share = percent(total === 0 ? 0 : Math.floor((done / total) * 100));
  return (
    <button
      type="button"
      className="link plain"
      title={t("sweep.underway.hint", { by, done, total })}
      onClick={() => showSweep(id)}
    >
      <StateWord tone="info" icon="record" word={t("sweep.underway", { share })} />
    </button>
  );
}

/** A signal that somebody added to the trace from elsewhere; a click shows the trace. */
function Added() {
  const path = useAdded((added) => added.path);
  return (
    <span role="status">
      {path !== null && (
        <button type="button" className="link plain" title={t("trace.added.hint")} onClick={showAdded}>
          <StateWord tone="info" icon="trigger" word={t("trace.added", { path })} />
        </button>
      )}
    </span>
  );
}

/** A download says nothing in the page by itself. */
function MadeTest() {
  const made = useTimeline((timeline) => timeline.made);
  return (
    <span role="status">
      {made?.expects && <StateWord tone="info" icon="export" word={t("scenario.made", made)} />}
      {made && !made.expects && (
        <StateWord
          tone="warning"
          icon="warning"
          word={t("scenario.made.nothing", { name: made.name })}
          title={t("scenario.made.nothing.hint")}
        />
      )}
    </span>
  );
}

function RunRefusal() {
  const order = useRun((run) => run.refused);
  const journey = useTimeline((timeline) => timeline.refused);
  const steps = useDebug((debug) => debug.refused);
  const refused = order ?? journey ?? steps;
  if (!refused) return null;
  return (
    <span className="st fatal" role="alert" title={refused}>
      <Icon name="error" />
      <span className="cut">{refused}</span>
    </span>
  );
}

function FileState() {
  const cursor = useDocuments((documents) => documents.cursor);
  const document = useDocuments((documents) => (documents.active ? documents.open[documents.active] : undefined));
  const you = usePlc((plc) => plc.you?.name);
  if (!document) return null;
  return (
    <>
      {cursor && <span>{t("status.place", cursor)}</span>}
      <span>ST</span>
      <span>{isDirty(document) ? t("unsaved") : savedOf(document, you)}</span>
    </>
  );
}

/** When the text was saved, and by whom if it was somebody else. */
function savedOf({ savedAt, savedBy, version }: Document, you: string | undefined): string {
  if (savedAt === "") return t("status.stored", { version });
  const at = isToday(savedAt) ? clockTime(savedAt) : dayTime(savedAt);
  return savedBy === "" || savedBy === you ? t("status.saved", { at }) : t("status.savedby", { at, author: savedBy });
}

function Language() {
  const language = usePrefs((prefs) => prefs.language);
  return (
    <MenuButton
      label={t("language")}
      className="link plain"
      items={() =>
        languages.map((known) => ({
          label: languageNames[known],
          checked: known === language,
          onSelect: () => chooseLanguage(known),
        }))
      }
    >
      {languageNames[language]}
    </MenuButton>
  );
}
