import { codeText } from "../../../logic/errors/codeText";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import type { ErrorInfo } from "../../../wire/types";

export type PageState = "open" | "now" | "done" | "bad";

const ICONS: Record<PageState, IconName> = { open: "never", now: "record", done: "check", bad: "error" };

interface Props {
  pages: readonly ErrorInfo[];
  stateOf: (error: ErrorInfo) => PageState;
  now: string;
  onPage: (index: number) => void;
}

/** The errors of the dialog, each with the state of its page. */
export function PageList({ pages, stateOf, now, onPage }: Props) {
  return (
    <ol aria-label={t("dialog.errors")}>
      {pages.map((error, index) => {
        const state = stateOf(error);
        return (
          <li key={error.id}>
            <button
              type="button"
              className={`step ${state}${error.id === now ? " on" : ""}`}
              aria-current={error.id === now ? "step" : undefined}
              onClick={() => onPage(index)}
            >
              <Icon name={ICONS[state]} />
              <span className="cut" title={error.name}>
                {error.name}
              </span>
              <small>
                {codeText(error.code)} · {error.flag}
              </small>
              <span className="sr">{t(`dialog.state.${state}`)}</span>
            </button>
          </li>
        );
      })}
    </ol>
  );
}
