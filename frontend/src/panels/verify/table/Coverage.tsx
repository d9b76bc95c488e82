import { grouped } from "../../../logic/format/numbers";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import type { VerifyCompared, VerifyCoverage } from "../../../wire/types";
import "./coverage.css";

const WIDTH = 760;
const COUNTS = ["compared", "differing", "allowed", "left_open", "missing"] as const;

interface Props {
  coverage: VerifyCoverage;
  trace: string;
  onClose: () => void;
}

/** What of a controller log was compared, and what was not. */
export function Coverage({ coverage, trace, onClose }: Props) {
  return (
    <Dialog
      title={t("verify.coverage")}
      about={t("verify.coverage.about", { name: trace })}
      width={WIDTH}
      onClose={onClose}
      onSubmit={onClose}
      footer={
        <>
          <span className="grow" />
          <button type="submit" className="btn primary">
            {t("close")}
          </button>
        </>
      }
    >
      <div className="vfcoverage scroll">
        <table aria-label={t("verify.coverage")}>
          <thead>
            <tr>
              <th scope="col">{t("verify.coverage.output")}</th>
              {COUNTS.map((count) => (
                <th key={count} scope="col">
                  {t(`verify.coverage.${count}`)}
                </th>
              ))}
              <th scope="col">{t("verify.coverage.largest")}</th>
            </tr>
          </thead>
          <tbody>
            {coverage.outputs.map((each) => (
              <Line key={each.column} compared={each} />
            ))}
          </tbody>
        </table>
        <dl>
          <Names word={t("verify.coverage.inputs")} names={coverage.inputs} />
          <Names word={t("verify.coverage.ignored")} names={coverage.ignored} />
          <Names word={t("verify.coverage.assumed")} names={coverage.assumed} />
          <Names word={t("verify.coverage.ungiven")} names={coverage.ungiven} />
          <Names word={t("verify.coverage.remembered")} names={coverage.remembered} />
          <Names word={t("verify.coverage.unrecorded")} names={coverage.unrecorded} />
        </dl>
        {coverage.more > 0 && <p className="faint">{t("verify.coverage.more", { count: grouped(coverage.more) })}</p>}
      </div>
    </Dialog>
  );
}

function Line({ compared }: { compared: VerifyCompared }) {
  const { path, column, differing, largest } = compared;
  return (
    <tr className={differing > 0 ? "st-bad" : ""}>
      <th scope="row" className="mono" title={column}>
        {path}
      </th>
      {COUNTS.map((count) => (
        <td key={count} className={compared[count] === 0 ? "faint" : ""}>
          {grouped(compared[count])}
        </td>
      ))}
      <td className="mono">{largest === 0 ? "" : String(Number(largest.toPrecision(4)))}</td>
    </tr>
  );
}

function Names({ word, names }: { word: string; names: readonly string[] }) {
  if (names.length === 0) return null;
  return (
    <>
      <dt>{word}</dt>
      <dd className="mono">{names.join(", ")}</dd>
    </>
  );
}
