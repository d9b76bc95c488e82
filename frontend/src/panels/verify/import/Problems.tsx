import { t } from "../../../text";
import type { TraceProblem } from "../../../wire/types";

/** Where a problem is: row, column, both, or the file as a whole. */
export function placeOf({ row, column }: TraceProblem): string {
  const parts = [
    row === null ? "" : t("import.trace.problem.row", { row }),
    column === "" ? "" : t("import.trace.problem.column", { column }),
  ];
  return parts.filter(Boolean).join(", ");
}

/** What is wrong, and where, so that it can be mended. */
export function Problems({ problems }: { problems: readonly TraceProblem[] }) {
  return (
    <ul className="tiproblems" aria-label={t("import.trace.problems")}>
      {problems.map((problem, index) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: they come whole, and the same one may be there twice
        <li key={index}>
          <span className="faint mono">{placeOf(problem)}</span>
          <span className={problem.warning ? "muted" : ""}>{problem.message}</span>
        </li>
      ))}
    </ul>
  );
}
