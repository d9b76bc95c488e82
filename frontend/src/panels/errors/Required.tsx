import { evidenceOf, isUnmet, isUntried, REQUIREMENTS } from "../../logic/errors/required";
import { openFile } from "../../store/page/navigate";
import { t } from "../../text";
import { StateWord } from "../../ui/StateWord";
import type { Reaction } from "../../wire/types";
import "./required.css";

type Found = Pick<Reaction, "required"> & Partial<Pick<Reaction, "restarts">>;

/** What the project requires when the error comes and goes, and what became of each requirement; and restarts that it does not allow. */
export function Required({ required, restarts = [] }: Found) {
  return (
    <>
      <OfProject required={required} restarts={restarts.filter((each) => each.allowed_by)} />
      <Unexpected restarts={restarts.filter((each) => !each.allowed_by)} />
    </>
  );
}

/** No project requires this: it is checked in each. */
function Unexpected({ restarts }: Pick<Reaction, "restarts">) {
  if (restarts.length === 0) return null;
  return (
    <section className="required" aria-label={t("required.restart.rule")}>
      <span className="faint">{t("required.restart.rule")}</span>
      <ul>
        {restarts.map(({ path, scan }) => (
          <li key={path}>
            <StateWord tone="never_read" icon="warning" word={t("required.restart")} />
            <span className="mono">{path}</span>
            <span className="why muted">{t("required.restart.about", { scan, name: path })}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}

function OfProject({ required, restarts }: Pick<Reaction, "required" | "restarts">) {
  if (required.length === 0 && restarts.length === 0) return null;
  return (
    <section className="required" aria-label={t("required.label")}>
      <span className="faint">{t("required.label")}</span>
      <ul>
        {restarts.map(({ path, scan, allowed_by: rule }) => (
          <li key={path}>
            <StateWord tone="acted" icon="check" word={t("required.restart.allowed")} />
            <span className="mono">{path}</span>
            <span className="why muted">{t("required.restart.by", { scan, rule })}</span>
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
