import { type ReactNode, useMemo } from "react";
import {
  type Column,
  type HistoryLine,
  type HistoryView,
  historyLines,
  isFiltered,
  sortedBy,
} from "../../../logic/errors/history";
import { keyOf } from "../../../logic/plc/errorInstances";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { useColumns } from "../../../ui/useColumns";
import { Line } from "./Line";

interface Props {
  lines: readonly HistoryLine[];
  view: HistoryView;
  onView: (view: Partial<HistoryView>) => void;
  label: string;
  /** Times from a different day or a different PLC are shown with the date. */
  dated: boolean;
}

const COLUMNS: readonly { column: Column | "details"; word: () => string; className?: string }[] = [
  { column: "error", word: () => t("errors.error") },
  { column: "severity", word: () => t("errors.severity"), className: "c-severity" },
  { column: "status", word: () => t("errors.state") },
  { column: "reaction", word: () => t("errors.reaction") },
  { column: "scans", word: () => t("history.scans"), className: "num" },
  { column: "generated", word: () => t("history.generated") },
  { column: "recovered", word: () => t("history.recovered") },
  { column: "code", word: () => t("errors.code"), className: "c-code" },
  { column: "details", word: () => t("history.details") },
  { column: "by", word: () => t("log.by") },
  { column: "count", word: () => t("history.count"), className: "num c-count" },
];

/** One row for each error; a click on a column head sorts, a second one reverses the order, a third one restores the order of the catalogue. */
export function HistoryTable({ lines, view, onView, label, dated }: Props) {
  const { style, grip } = useColumns(useWidths("history"));
  const shown = useMemo(() => historyLines(lines, view), [lines, view]);
  if (shown.length === 0 && isFiltered(view)) return <p className="lonely faint">{t("history.nomatch")}</p>;
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
    <div className="scroll both hscroll" tabIndex={0}>
      <table className="htable" aria-label={label} style={style}>
        <thead>
          <tr>
            {COLUMNS.map(({ column, word, className }) =>
              column === "details" ? (
                <th key={column} scope="col" className="details">
                  {word()}
                </th>
              ) : (
                <Head key={column} column={column} word={word()} className={className} view={view} onView={onView}>
                  {column !== "count" && grip(column, word())}
                </Head>
              ),
            )}
          </tr>
        </thead>
        <tbody>
          {shown.map((line) => (
            <Line key={keyOf(line)} line={line} dated={dated} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

interface HeadProps {
  column: Column;
  word: string;
  className: string | undefined;
  view: HistoryView;
  onView: Props["onView"];
  children: ReactNode;
}

function Head({ column, word, className, view, onView, children }: HeadProps) {
  const down = view.sort?.column === column ? view.sort.down : null;
  return (
    <th
      scope="col"
      aria-label={word}
      className={className}
      aria-sort={down === null ? undefined : down ? "descending" : "ascending"}
    >
      <button
        type="button"
        className="headsort"
        title={t("history.sort", { column: word })}
        onClick={() => onView({ sort: sortedBy(view.sort, column) })}
      >
        {word}
        {down !== null && <Icon name={down ? "chev-d" : "chev-u"} small />}
      </button>
      {children}
    </th>
  );
}
