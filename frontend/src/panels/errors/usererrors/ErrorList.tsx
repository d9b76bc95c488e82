import type { KeyboardEvent } from "react";
import { groupText, problemsOf, textOf } from "../../../logic/errors/userErrors";
import { deleteError, selectUserError } from "../../../store/errors/userErrors";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { useColumns } from "../../../ui/useColumns";
import type { UserError, UserProblem } from "../../../wire/types";

interface Props {
  errors: readonly UserError[];
  problems: readonly UserProblem[];
  selected: number | null;
}

/** The errors, one a row. The list has the focus, the selected row is its active descendant. */
export function ErrorList({ errors, problems, selected }: Props) {
  const { style, grip } = useColumns(useWidths("usererrors"));

  function onKeyDown(event: KeyboardEvent): void {
    const now = selected ?? -1;
    const to = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: errors.length - 1 }[event.key];
    if (event.key === "Delete" && selected !== null) deleteError(selected);
    else if (to === undefined) return;
    else if (to >= 0 && to < errors.length) {
      selectUserError(to);
      document.getElementById(rowId(to))?.scrollIntoView({ block: "nearest" });
    }
    event.preventDefault();
  }

  return (
    <div className="uelist" data-columns style={style}>
      <div className="gr h uerow">
        <span>
          {t("usererrors.name")}
          {grip("name", t("usererrors.name"))}
        </span>
        <span>
          {t("errors.code")}
          {grip("code", t("errors.code"))}
        </span>
        <span>
          {t("errors.flag")}
          {grip("flag", t("errors.flag"))}
        </span>
        <span>{t("usererrors.severity")}</span>
      </div>
      <div
        className="scroll"
        role="listbox"
        tabIndex={0}
        aria-label={t("usererrors.list")}
        aria-activedescendant={selected === null ? undefined : rowId(selected)}
        onKeyDown={onKeyDown}
      >
        {errors.map((error, index) => (
          <Row
            // biome-ignore lint/suspicious/noArrayIndexKey: no other property of an error stays the same while it is edited
            key={index}
            index={index}
            error={error}
            wrong={problemsOf(problems, index).size}
            chosen={index === selected}
          />
        ))}
      </div>
    </div>
  );
}

const rowId = (index: number) => `usererror-${index}`;

interface RowProps {
  index: number;
  error: UserError;
  wrong: number;
  chosen: boolean;
}

function Row({ index, error, wrong, chosen }: RowProps) {
  const name = textOf(error.texts, "en", "name");
  const fatal = error.severity === "fatal";
  const problems = t("usererrors.problems", { count: wrong });
  return (
    <div
      id={rowId(index)}
      role="option"
      aria-selected={chosen}
      className={`gr uerow${chosen ? " on" : ""}`}
      title={groupText(error.group)}
      onClick={() => selectUserError(index)}
    >
      <span className="uename">
        <span className={`cut${name ? "" : " faint"}`}>{name || t("usererrors.noname")}</span>
        {wrong > 0 && (
          <span className="st fatal" title={problems}>
            <Icon name="error" small />
            {wrong}
            <span className="sr">{problems}</span>
          </span>
        )}
      </span>
      <span className="mono">{error.code || "–"}</span>
      <span className="mono">{error.flag}</span>
      <span className={`st ${fatal ? "fatal" : "warning"}`}>
        <Icon name={fatal ? "fatal" : "warning"} small />
        {t(fatal ? "errors.fatal" : "errors.nonfatal")}
      </span>
    </div>
  );
}
