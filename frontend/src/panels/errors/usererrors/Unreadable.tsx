import { USER_ERRORS } from "../../../logic/errors/userErrors";
import { openFile } from "../../../store/page/navigate";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { UserProblem } from "../../../wire/types";

/** The file cannot be read as errors.xml: what is wrong with it, and a button that opens its text. */
export function Unreadable({ problems }: { problems: readonly UserProblem[] }) {
  return (
    <div className="empty">
      <div role="alert">
        <h3>{t("usererrors.unreadable")}</h3>
        <ul className="uewrong">
          {problems.map((problem) => (
            <li key={`${problem.line}:${problem.column}:${problem.message}`} className="st fatal">
              <Icon name="error" small />
              <button
                type="button"
                className="link plain"
                onClick={() => openFile(USER_ERRORS, problem.line, problem.column)}
              >
                {t("usererrors.unreadable.line", problem)}
              </button>
            </li>
          ))}
        </ul>
      </div>
      <div>
        <button type="button" className="btn" onClick={() => openFile(USER_ERRORS, problems[0]?.line ?? 1)}>
          {t("usererrors.openfile")}
        </button>
      </div>
    </div>
  );
}
