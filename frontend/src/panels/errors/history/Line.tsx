import { detailsInWords, isSwept, reactionOf } from "../../../logic/errors/catalogue";
import { codeText } from "../../../logic/errors/codeText";
import type { HistoryLine } from "../../../logic/errors/history";
import { dayTime, grouped, wallTime } from "../../../logic/format/numbers";
import { keyOf } from "../../../logic/plc/errorInstances";
import { useCatalogue } from "../../../store/errors/catalogue";
import { selectError } from "../../../store/errors/simulator";
import { showPanel } from "../../../store/page/navigate";
import { showRerun } from "../../../store/past/reruns";
import { travel } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import { ReactionWord } from "../../../ui/ReactionWord";
import { StateWord } from "../../../ui/StateWord";
import { StatusWord } from "../../../ui/StatusWord";
import { acknowledgedBy } from "../acknowledgedBy";

/** One error: how often it was raised, and how the program reacted. */
export function Line({ line, dated }: { line: HistoryLine; dated: boolean }) {
  const { byId } = useCatalogue();
  const words = line.details && detailsInWords(byId.get(line.id), line.details);
  const details = [line.label, words].filter(Boolean).join(", ");
  const fatal = line.severity === "fatal";
  return (
    <tr data-error={keyOf(line)} className={line.fitted === false ? "absent" : undefined}>
      <th scope="row" title={line.name}>
        <span className="hname cut">{dated ? line.name : <Choice line={line} />}</span>
        {details && <span className="which">{details}</span>}
      </th>
      <td className="c-severity">
        <StateWord
          tone={fatal ? "fatal" : "warning"}
          icon={fatal ? "fatal" : "warning"}
          word={t(fatal ? "errors.fatal" : "errors.nonfatal")}
        />
      </td>
      <td>
        <StatusWord status={line.status} swept={isSwept(line) && line.status === "never"} way={line.recovered_way} />
        {line.acknowledged && <Acknowledged seen={line.acknowledged} />}
      </td>
      <td>
        <Reaction line={line} />
      </td>
      <td className="num">{reactionOf(line)?.scans ?? ""}</td>
      <Moment at={line.generated_at} scan={line.generated_scan} dated={dated} error={dated ? null : keyOf(line)} />
      <Moment at={line.recovered_at} scan={line.recovered_scan} dated={dated} error={null} by={line.recovered_by} />
      <td className="mono c-code">{line.status === "never" ? "" : codeText(line.code)}</td>
      <td className="details" title={details || undefined}>
        {details}
      </td>
      <td title={line.origin ? t(`origin.${line.origin}`) : undefined}>{line.by ?? ""}</td>
      <td className="num c-count">{line.count || ""}</td>
    </tr>
  );
}

/** The name leads to this row, and no other of its kind, in the error simulator. */
function Choice({ line }: { line: HistoryLine }) {
  return (
    <button
      type="button"
      className="link plain"
      title={t("history.choose", { error: line.name })}
      onClick={() => {
        selectError(keyOf(line));
        showPanel("errors");
      }}
    >
      {line.name}
    </button>
  );
}

/** Somebody has seen it at an alarm list. */
function Acknowledged({ seen }: { seen: NonNullable<HistoryLine["acknowledged"]> }) {
  return (
    <span className="faint" title={acknowledgedBy(seen)}>
      {" "}
      {t("history.acknowledged")}
    </span>
  );
}

function Reaction({ line }: { line: HistoryLine }) {
  const reaction = reactionOf(line);
  const swept = isSwept(line);
  const { accepted } = line;
  if (!reaction) return null;
  const title = [
    reaction.message,
    swept ? t("history.swept") : "",
    accepted ? t("history.accepted", { accepted }) : "",
  ].filter(Boolean);
  return (
    <>
      <ReactionWord reaction={reaction} title={title.join(" · ")} />
      {swept && <span className="faint"> {t("reaction.swept.word")}</span>}
      {accepted && <span className="faint"> {t("sweep.accepted")}</span>}
    </>
  );
}

interface MomentProps {
  /** Who it was, where no column says it. */
  by?: string;
  at: string | null;
  scan: number | null;
  dated: boolean;
  /** The error that was raised at this time in the selected run; null: it cannot be replayed. */
  error: string | null;
}

function Moment({ at, scan, dated, error, by }: MomentProps) {
  const before = scan === null ? "" : t("history.scan", { scan: grouped(scan) });
  const time = at === null ? "" : dated ? dayTime(at) : wallTime(at);
  return (
    <td className="mono" title={[at, before, by && t("history.by", { by })].filter(Boolean).join(" · ") || undefined}>
      {time}{" "}
      {scan !== null && error !== null ? (
        <MenuButton
          label={t("rerun.of", { scan: grouped(scan) })}
          className="link"
          items={() => thenItems(scan, error)}
        >
          <span className="scan">{before}</span>
          <Icon name="chev-d" small />
        </MenuButton>
      ) : (
        before && <span className="faint scan">{before}</span>
      )}
    </td>
  );
}

/** Goes to the scan before which the error was raised, or replays the run with a change of this error. */
function thenItems(scan: number, error: string): MenuItem[] {
  const of = { scan, error };
  return [
    { label: t("changes.goto", { scan: grouped(scan) }), icon: "moved", onSelect: () => void travel(scan) },
    {
      label: t("rerun.menu.instead"),
      icon: "branch",
      separated: true,
      onSelect: () => showRerun(of, { how: "instead" }),
    },
    { label: t("rerun.menu.earlier"), onSelect: () => showRerun(of, { by: -1 }) },
    { label: t("rerun.menu.later"), onSelect: () => showRerun(of, { by: 1 }) },
    { label: t("rerun.menu.out"), onSelect: () => showRerun(of, { how: "out" }) },
  ];
}
