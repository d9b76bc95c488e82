import { grouped } from "../../../logic/format/numbers";
import { changeOf } from "../../../logic/verify/whatif";
import { saveTest } from "../../../store/verify/whatif";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { StateWord } from "../../../ui/StateWord";
import type { WhatIf, WhatIfTry } from "../../../wire/types";

/** The run as it was recorded, and each try beside it. */
export function Results({ found }: { found: WhatIf }) {
  const { wanted, recorded, undisturbed, tries, best, note, scenario } = found;
  return (
    <section className="whatifview" aria-label={t("whatif.results")}>
      {(note || scenario) && (
        <div className="sub tall whatifhead">
          {note && <span className="st halted">{note}</span>}
          <span className="grow" />
          {scenario && (
            <button type="button" className="btn sm" title={t("whatif.test.about")} onClick={() => saveTest(scenario)}>
              <Icon name="export" small />
              {t("whatif.test")}
            </button>
          )}
        </div>
      )}
      <div className="scroll whatiftable">
        <table aria-label={t("whatif.results")}>
          <thead>
            <tr>
              <th scope="col">{t("whatif.head.values")}</th>
              {wanted.condition && (
                <th scope="col" title={wanted.condition}>
                  {t("whatif.head.met")}
                </th>
              )}
              <th scope="col">{t("whatif.head.output")}</th>
              {wanted.watch.map((path) => (
                <th key={path} scope="col" className="mono">
                  {path}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            <Line tried={recorded} found={found} best={false} name={t("whatif.recorded")} />
            {undisturbed && <Line tried={undisturbed} found={found} best={false} name={t("whatif.undisturbed")} />}
            {tries.map((tried, at) => (
              // biome-ignore lint/suspicious/noArrayIndexKey: the tries of one answer keep their places
              <Line key={at} tried={tried} found={found} best={at === best} />
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

interface LineProps {
  tried: WhatIfTry;
  found: WhatIf;
  best: boolean;
  /** Of what has no other values. */
  name?: string;
}

function Line({ tried, found: { wanted, recorded }, best, name }: LineProps) {
  const { met, output_scan: output, shown, trapped, refused, ran, compared } = tried;
  const isRecorded = tried === recorded;
  return (
    <tr className={best ? "on" : ""} data-best={best || undefined}>
      <td className={name ? "muted" : "mono"}>
        {name ?? changeOf(tried)}
        {best && <StateWord tone="running" icon="check" word={t("whatif.best")} />}
        {trapped && <small className="st fatal">{t("whatif.trapped", { text: trapped })}</small>}
        {refused.map((each) => (
          <small key={each} className="st warning">
            {each}
          </small>
        ))}
      </td>
      {wanted.condition && <td>{ran > 0 && <Met met={met} />}</td>}
      <td className={output === null ? "muted" : ""}>
        {ran > 0 &&
          !isRecorded &&
          (output === null || output === undefined
            ? compared > 0 &&
              t(compared === ran ? "whatif.output.same" : "whatif.output.part", { count: grouped(compared) })
            : t("whatif.output", { scan: grouped(output) }))}
      </td>
      {wanted.watch.map((path, at) => (
        <td key={path} className="mono">
          {shown[at]}
        </td>
      ))}
    </tr>
  );
}

function Met({ met }: { met: WhatIfTry["met"] }) {
  if (met === null || met === undefined) return <span className="faint">{t("whatif.met.not")}</span>;
  return <StateWord tone="running" icon="check" word={t("whatif.met", { scan: grouped(met) })} />;
}
