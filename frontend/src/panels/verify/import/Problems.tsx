import { grouped } from "../../../logic/format/numbers";
import { t } from "../../../text";
import type { TraceProblem } from "../../../wire/types";

/** The place of a problem: row, column, both, or the whole file. */
export function placeOf({ row, column }: TraceProblem): string {
  const parts = [
    row === null ? "" : t("import.trace.problem.row", { row }),
    column === "" ? "" : t("import.trace.problem.column", { column }),
  ];
  return parts.filter(Boolean).join(", ");
}

interface Props {
  problems: readonly TraceProblem[];
  /** Maps the column of a problem to a variable that may be meant. */
  onTake?: (column: string, path: string) => void;
}

/** The problems and their places, so that they can be corrected. */
export function Problems({ problems, onTake }: Props) {
  return (
    <ul className="tiproblems" aria-label={t("import.trace.problems")}>
      {problems.map((problem, index) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: the list is always replaced as a whole, and may contain the same problem twice
        <li key={index}>
          <span className="faint mono">{placeOf(problem)}</span>
          <span className={problem.warning ? "muted" : ""}>
            {problem.message}
            {problem.more > 0 && (
              <span className="faint">
                {" "}
                {t("import.trace.problem.more", { count: grouped(problem.more), last: problem.last ?? "" })}
              </span>
            )}
            {onTake &&
              problem.near.map((path) => (
                <button key={path} type="button" className="link titake" onClick={() => onTake(problem.column, path)}>
                  {t("import.trace.take", { path })}
                </button>
              ))}
          </span>
        </li>
      ))}
    </ul>
  );
}
