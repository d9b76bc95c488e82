import { pouAt } from "../../logic/explorer";
import { t } from "../../logic/text";
import { build, isDirty, save, useDocuments } from "../../store/documents";
import { showPanel } from "../../store/navigate";
import { useLost } from "../../store/plc";
import { toggleChecks, usePrefs } from "../../store/prefs";
import { Icon } from "../../ui/Icon";
import { StateWord } from "../../ui/StateWord";

/** Above the text: what it declares, what the last build said, save and build. */
export function EditorBar({ path }: { path: string }) {
  const pous = useDocuments((documents) => documents.pous);
  const cursor = useDocuments((documents) => (documents.active === path ? documents.cursor : null));
  const dirty = useDocuments((documents) => isDirty(documents.open[path]));
  const building = useDocuments((documents) => documents.build.phase === "running");
  const lost = useLost();
  // Not a subscription: the caret moves with every change of the text.
  const text = useDocuments.getState().open[path]?.text;
  const found = pouAt(pous, path, cursor?.line ?? 1, text) ?? pous.find((known) => known.file === path);
  // A global variable is one line of the file, not what the file is about.
  const pou = found?.kind === "global" ? { name: path, kind: found.kind } : found;
  return (
    <div className="sub">
      <span className="cut">{pou?.name ?? path}</span>
      {pou && <span className="faint cut">{t(`kind.${pou.kind}`)}</span>}
      <span className="grow" />
      <BuildOutcome />
      <ChecksToggle />
      <button
        type="button"
        className="btn quiet sm"
        disabled={!dirty || lost}
        title={lost ? t("lost.nosave") : t("save.hint")}
        onClick={() => void save(path)}
      >
        {t("save")}
      </button>
      <button
        type="button"
        className="btn sm"
        disabled={building || lost}
        title={lost ? t("lost.nobuild") : t("build.hint")}
        onClick={() => void build()}
      >
        <Icon name="play" small />
        {building ? t("building") : t("build")}
      </button>
    </div>
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

function BuildOutcome() {
  const state = useDocuments((documents) => documents.build);
  if (state.phase !== "done") return null;
  const by = state.author ? t("build.by", { author: state.author }) : "";
  return (
    <button
      type="button"
      className="link plain cut"
      title={state.message}
      role="status"
      onClick={() => showPanel("problems")}
    >
      {state.ok ? (
        <StateWord tone="running" icon="check" word={`${t("build.ok")}${by}`} />
      ) : (
        <StateWord tone="fatal" icon="error" word={`${t("build.refused")}${by}`} />
      )}
    </button>
  );
}
