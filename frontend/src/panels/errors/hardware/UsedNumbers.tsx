import { type Fitted, withItem } from "../../../logic/errors/hardware";
import { changeHardware } from "../../../store/errors/hardware";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { RaisedNumber } from "../../../wire/types";
import { whatIs } from "./words";

const itemOf = ({ kind, number, text }: RaisedNumber) => ({ kind, number, name: text });

/** The numbers that the program raises and the file does not have: each is added with a click. */
export function UsedNumbers({ kind, fitted }: { kind: string; fitted: readonly Fitted[] }) {
  const numbers = useDocuments((documents) => documents.numbers);
  const broken = useDocuments(({ problems }) => problems.some(({ severity }) => severity === "error"));
  if (numbers === null) return broken ? <p className="hint hwused">{t("hardware.used.broken")}</p> : null;
  const missing = numbers.filter(
    (each) => each.kind === kind && !fitted.some(({ item }) => item.number === each.number),
  );
  if (missing.length === 0) return null;
  const add = (all: readonly RaisedNumber[]) =>
    changeHardware((text) => all.reduce((made, each) => withItem(made, itemOf(each)), text));
  return (
    <p className="hwused row wrap">
      <span className="muted" title={t("hardware.used.more")}>
        {t("hardware.used")}
      </span>
      {missing.map((each) => {
        const what = [whatIs(itemOf(each)), each.text].filter(Boolean).join(" ");
        return (
          <button
            key={each.number}
            type="button"
            className="btn quiet sm"
            aria-label={t("hardware.used.add", { what })}
            title={`${each.file}:${each.line}`}
            onClick={() => add([each])}
          >
            <Icon name="plus" small />
            {what}
          </button>
        );
      })}
      {missing.length > 1 && (
        <button type="button" className="btn sm" onClick={() => add(missing)}>
          {t("hardware.all", { count: missing.length })}
        </button>
      )}
    </p>
  );
}
