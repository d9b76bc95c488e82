import type { HistoryView } from "../../../logic/errors/history";
import { VERDICTS } from "../../../logic/errors/sweep";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";

const STATUSES = ["all", "never", "generated", "cleared"] as const;
const SEVERITIES = ["all", "fatal", "nonfatal"] as const;
const REACTIONS = ["all", "findings", ...VERDICTS, "unknown"] as const;

const severityWord = (severity: (typeof SEVERITIES)[number]) =>
  t(severity === "all" ? "errors.severity.all" : severity === "fatal" ? "errors.fatal" : "errors.nonfatal");

const reactionWord = (reaction: (typeof REACTIONS)[number]) =>
  reaction === "all" || reaction === "findings" || reaction === "unknown"
    ? t(`errors.reaction.${reaction}`)
    : t(`verdict.${reaction}`);

interface Props {
  view: HistoryView;
  onView: (view: Partial<HistoryView>) => void;
}

/** A text field, and a menu for each of state, severity and reaction; the button of a menu says what it filters. */
export function Filters({ view, onView }: Props) {
  return (
    <>
      <span className="inp sm hsearch">
        <Icon name="search" small />
        <input
          type="search"
          aria-label={t("history.filter")}
          placeholder={t("history.filter")}
          value={view.text}
          spellCheck={false}
          onChange={(event) => onView({ text: event.target.value })}
        />
      </span>
      <Choice
        name={t("errors.state")}
        all={STATUSES}
        now={view.status}
        wordOf={(status) => t(`errors.status.${status}`)}
        onChoose={(status) => onView({ status })}
      />
      <Choice
        name={t("errors.severity")}
        all={SEVERITIES}
        now={view.severity}
        wordOf={severityWord}
        onChoose={(severity) => onView({ severity })}
      />
      <Choice
        name={t("errors.reaction")}
        all={REACTIONS}
        now={view.reaction}
        wordOf={reactionWord}
        onChoose={(reaction) => onView({ reaction })}
      />
    </>
  );
}

interface ChoiceProps<T extends string> {
  name: string;
  all: readonly T[];
  now: T;
  wordOf: (value: T) => string;
  onChoose: (value: T) => void;
}

function Choice<T extends string>({ name, all, now, wordOf, onChoose }: ChoiceProps<T>) {
  const items = (): MenuItem[] =>
    all.map((value) => ({ label: wordOf(value), checked: value === now, onSelect: () => onChoose(value) }));
  return (
    <MenuButton
      label={t("history.filter.of", { name, filter: wordOf(now) })}
      className={`btn quiet sm filters${now === "all" ? "" : " is-on"}`}
      items={items}
    >
      <span className="cut">{now === "all" ? name : wordOf(now)}</span>
      <Icon name="chev-d" small />
    </MenuButton>
  );
}
