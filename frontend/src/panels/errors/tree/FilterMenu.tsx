import { useShallow } from "zustand/react/shallow";
import { VERDICTS } from "../../../logic/errors/sweep";
import { setFilters, useSimulator } from "../../../store/errors/simulator";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";

const STATUSES = ["all", "never", "generated", "cleared"] as const;
const SEVERITIES = ["all", "fatal", "nonfatal"] as const;
const REACTIONS = ["all", "findings", ...VERDICTS, "unknown"] as const;

type Reaction = (typeof REACTIONS)[number];

const severityWord = (severity: (typeof SEVERITIES)[number]) =>
  t(severity === "all" ? "errors.severity.all" : severity === "fatal" ? "errors.fatal" : "errors.nonfatal");

function reactionWord(reaction: Reaction): string {
  if (reaction === "all" || reaction === "findings" || reaction === "unknown") return t(`errors.reaction.${reaction}`);
  return t(`verdict.${reaction}`);
}

/** Filters the errors by state, severity and reaction. The button says which filter is set. */
export function FilterMenu() {
  const { status, severity, reaction } = useSimulator(
    useShallow(({ status, severity, reaction }) => ({ status, severity, reaction })),
  );
  const shown = [
    status === "all" ? "" : t(`errors.status.${status}`),
    severity === "all" ? "" : severityWord(severity),
    reaction === "all" ? "" : reactionWord(reaction),
  ].filter(Boolean);
  const words = shown.join(", ") || t("errors.status.all");

  function items(): MenuItem[] {
    const states = STATUSES.map((value) => ({
      label: t(`errors.status.${value}`),
      checked: value === status,
      onSelect: () => setFilters({ status: value }),
    }));
    const severities = SEVERITIES.map((value, index) => ({
      label: severityWord(value),
      checked: value === severity,
      separated: index === 0,
      onSelect: () => setFilters({ severity: value }),
    }));
    const reactions = REACTIONS.map((value, index) => ({
      label: reactionWord(value),
      checked: value === reaction,
      separated: index === 0,
      onSelect: () => setFilters({ reaction: value }),
    }));
    return [...states, ...severities, ...reactions];
  }

  return (
    <MenuButton
      label={t("errors.filters", { filter: words })}
      className={`btn quiet sm filters${shown.length > 0 ? " is-on" : ""}`}
      items={items}
    >
      <span className="cut">{words}</span>
      <Icon name="chev-d" small />
    </MenuButton>
  );
}
