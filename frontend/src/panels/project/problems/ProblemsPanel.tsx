import { Fragment } from "react";
import { clockTime } from "../../../logic/format/numbers";
import { problemHelp } from "../../../logic/page/help";
import { useWidths } from "../../../store/page/columns";
import { showHelp } from "../../../store/page/help";
import { openFile } from "../../../store/page/navigate";
import { useDocuments } from "../../../store/project/documents";
import { useCorrected } from "../../../store/project/refusedBuild";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { useColumns } from "../../../ui/useColumns";
import type { Problem } from "../../../wire/types";
import { PastNote } from "../PastNote";

const LOOK: Record<Problem["severity"], { icon: IconName; tone: string }> = {
  error: { icon: "error", tone: "fatal" },
  warning: { icon: "warning", tone: "warning" },
  info: { icon: "info", tone: "info" },
};

/** The problems that the compiler finds in the texts while they are edited. A click goes to the place. */
export function ProblemsPanel() {
  const problems = useDocuments((documents) => documents.problems);
  const trouble = useDocuments((documents) => documents.trouble);
  const build = useDocuments((documents) => documents.build);
  const corrected = useCorrected();
  const refused = build.phase === "done" && !build.ok && !corrected ? build : null;
  return (
    <div className="pane flexcol" data-pane="problems">
      <PastNote of="problems" />
      {trouble && <Line tone="fatal" text={trouble} />}
      {refused && (
        <Line tone="fatal" text={t("build.refused.at", { at: clockTime(refused.at), message: refused.message })} />
      )}
      {problems.length === 0 && !trouble && !refused ? (
        <p className="lonely faint">{t("problems.none")}</p>
      ) : (
        <List problems={problems} />
      )}
    </div>
  );
}

function List({ problems }: { problems: readonly Problem[] }) {
  const { style, grip } = useColumns(useWidths("problems"));
  return (
    <div className="grid scroll problems" data-columns style={style}>
      <div className="gr h">
        {(["severity", "message", "code"] as const).map((column) => (
          <span key={column}>
            {t(`problems.${column}`)}
            {grip(column, t(`problems.${column}`))}
          </span>
        ))}
        <span>{t("problems.place")}</span>
      </div>
      <ul aria-label={t("problems.list")}>
        {problems.map((problem) => (
          <li key={`${problem.file}:${problem.line}:${problem.column}:${problem.code}:${problem.message}`}>
            <Row problem={problem} />
          </li>
        ))}
      </ul>
    </div>
  );
}

function Line({ tone, text }: { tone: string; text: string }) {
  return (
    <p className={`trouble st ${tone}`} role="alert">
      <Icon name="error" small />
      <span>{text}</span>
    </p>
  );
}

/** A long path is broken after a folder, so that the name of the file is in one piece. */
function Place({ file, at }: { file: string; at: string }) {
  const parts = file.split("/");
  const folders = parts.slice(0, -1);
  return (
    <>
      {folders.map((folder, index) => (
        <Fragment key={folders.slice(0, index + 1).join("/")}>
          {folder}/<wbr />
        </Fragment>
      ))}
      {`${parts.at(-1)}:${at}`}
    </>
  );
}

function Row({ problem }: { problem: Problem }) {
  const { icon, tone } = LOOK[problem.severity];
  return (
    <button
      type="button"
      className="gr"
      data-help={problemHelp(problem.code)}
      onClick={() => openFile(problem.file, problem.line, problem.column)}
    >
      <span className={`st ${tone}`}>
        <Icon name={icon} small />
        {t(`severity.${problem.severity}`)}
      </span>
      <span className="says">{problem.message}</span>
      {/* Not a button, because a button must not contain one: the keyboard has F1. */}
      <span
        className="mono link"
        title={t("help.of", { panel: problem.code })}
        onClick={(event) => {
          event.stopPropagation();
          showHelp(problemHelp(problem.code));
        }}
      >
        {problem.code}
      </span>
      <span className="mono muted place">
        <Place file={problem.file} at={`${problem.line}:${problem.column}`} />
      </span>
    </button>
  );
}
