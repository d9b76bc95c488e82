import { detailsInWords, isSwept, reactionOf } from "../../logic/catalogue";
import type { HistoryLine } from "../../logic/history";
import { dayTime, grouped, wallTime } from "../../logic/numbers";
import { t } from "../../logic/text";
import { useCatalogue } from "../../store/catalogue";
import { ReactionWord } from "../../ui/ReactionWord";
import { StateWord } from "../../ui/StateWord";
import { STATUS_ICONS } from "../../ui/statuses";

/** One error: what was done with it, and what the program did about it. */
export function Line({ line, dated }: { line: HistoryLine; dated: boolean }) {
  const details = detailsInWords(useCatalogue().byId.get(line.id), line.details);
  const fatal = line.severity === "fatal";
  return (
    <tr data-error={line.id}>
      <th scope="row" title={line.name}>
        {line.name}
      </th>
      <td className="c-severity">
        <StateWord
          tone={fatal ? "fatal" : "warning"}
          icon={fatal ? "fatal" : "warning"}
          word={t(fatal ? "errors.fatal" : "errors.nonfatal")}
        />
      </td>
      <td>
        <StateWord tone={line.status} icon={STATUS_ICONS[line.status]} word={t(`errors.status.${line.status}`)} />
      </td>
      <td>
        <Reaction line={line} />
      </td>
      <td className="num">{reactionOf(line)?.scans ?? ""}</td>
      <Moment at={line.generated_at} scan={line.generated_scan} dated={dated} />
      <Moment at={line.recovered_at} scan={line.recovered_scan} dated={dated} />
      <td className="mono c-code">{line.status === "never" ? "" : line.code}</td>
      <td className="details" title={details || undefined}>
        {details}
      </td>
      <td title={line.origin ? t(`origin.${line.origin}`) : undefined}>{line.by ?? ""}</td>
      <td className="num">{line.count || ""}</td>
    </tr>
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

function Moment({ at, scan, dated }: { at: string | null; scan: number | null; dated: boolean }) {
  const before = scan === null ? "" : t("history.scan", { scan: grouped(scan) });
  const time = at === null ? "" : dated ? dayTime(at) : wallTime(at);
  return (
    <td className="mono" title={[at, before].filter(Boolean).join(" · ") || undefined}>
      {time}
      {before && <span className="faint scan"> {before}</span>}
    </td>
  );
}
