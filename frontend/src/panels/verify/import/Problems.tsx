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

/** The problems and their places, so that they can be corrected. */
export function Problems({ problems }: { problems: readonly TraceProblem[] }) {
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
          </span>
        </li>
      ))}
    </ul>
  );
}
