import { evidenceOf, isUnmet, isUntried, REQUIREMENTS } from "../../logic/errors/required";
import { openFile } from "../../store/page/navigate";
import { t } from "../../text";
import { StateWord } from "../../ui/StateWord";
import type { Reaction } from "../../wire/types";
import "./required.css";

/** What the project requires when the error comes and goes, and what became of each requirement. */
export function Required({
  required,
  restarts = [],
}: Pick<Reaction, "required"> & Partial<Pick<Reaction, "restarts">>) {
  if (required.length === 0 && restarts.length === 0) return null;
  return (
    <section className="required" aria-label={t("required.label")}>
      <span className="faint">{t("required.label")}</span>
      <ul>
        {restarts.map((restart) => (
          <li key={restart.path}>
            {restart.allowed_by ? (
              <StateWord tone="acted" icon="check" word={t("required.restart.allowed")} />
            ) : (
              <StateWord tone="never_read" icon="warning" word={t("required.restart")} />
            )}
            <span className="mono">{restart.path}</span>
            <span className="why muted">
              {t(restart.allowed_by ? "required.restart.by" : "required.restart.about", {
                scan: restart.scan,
                rule: restart.allowed_by,
              })}
            </span>
          </li>
        ))}
        {required.map((each) => (
          <li key={`${each.line} ${each.text}`} data-outcome={each.outcome}>
            <StateWord {...lookOf(each)} />
            <button
              type="button"
              className="link mono"
              title={t("sweep.goto", { file: REQUIREMENTS, line: each.line })}
              onClick={() => openFile(REQUIREMENTS, each.line)}
            >
              {each.text}
            </button>
            <span className="why muted">{evidenceOf(each)}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}

function lookOf(each: Reaction["required"][number]) {
  if (each.outcome === "passed") return { tone: "acted", icon: "check", word: t("required.passed") } as const;
  if (each.outcome === "failed") return { tone: "never_read", icon: "error", word: t("required.failed") } as const;
  if (isUntried(each))
    return { tone: isUnmet(each) ? "never_read" : "never", icon: "info", word: t("required.not_tried") } as const;
  return { tone: isUnmet(each) ? "displayed" : "never", icon: "info", word: t("required.not_checked") } as const;
}
