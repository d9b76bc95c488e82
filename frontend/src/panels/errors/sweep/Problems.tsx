import { REQUIREMENTS } from "../../../logic/errors/required";
import { openFile } from "../../../store/page/navigate";
import { t } from "../../../text";
import { StateWord } from "../../../ui/StateWord";
import type { Sweep } from "../../../wire/types";

/** Mistakes in what the project requires: what it says there was not tried. */
export function Problems({ sweep }: { sweep: Sweep }) {
  const problems = sweep.problems ?? [];
  if (problems.length === 0) return null;
  return (
    <ul className="swproblems" aria-label={t("sweep.problems")}>
      {problems.map(({ line, column, message }) => (
        <li key={`${line}:${column} ${message}`}>
          <StateWord tone="never_read" icon="error" word={t("required.not_tried")} />
          <button
            type="button"
            className="link mono"
            title={t("sweep.goto", { file: REQUIREMENTS, line })}
            onClick={() => openFile(REQUIREMENTS, line)}
          >
            {`${REQUIREMENTS}:${line}`}
          </button>
          <span className="muted">{message}</span>
        </li>
      ))}
    </ul>
  );
}
