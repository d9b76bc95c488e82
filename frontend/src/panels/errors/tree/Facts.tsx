import { legendOf } from "../../../logic/errors/sources";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { ErrorInfo } from "../../../wire/types";
import "./facts.css";

type Fact = ErrorInfo["facts"][number];
const NAMES = ["flag", "code", "severity", "priority", "cause", "memory", "log", "details", "text"] as const;
const isKnown = (of: string): of is (typeof NAMES)[number] => (NAMES as readonly string[]).includes(of);

/** Where each fact of an error comes from, and whether somebody looked it up; folded until it is wanted. */
export function Facts({ facts }: { facts: readonly Fact[] }) {
  if (facts.length === 0) return null;
  const verified = facts.filter((fact) => fact.verified).length;
  return (
    <details className="facts">
      <summary>{t("facts.title", { verified, count: facts.length })}</summary>
      <table aria-label={t("facts.label")}>
        <thead>
          <tr>
            <th scope="col">{t("facts.fact")}</th>
            <th scope="col">{t("facts.value")}</th>
            <th scope="col">{t("facts.looked")}</th>
            <th scope="col">{t("facts.source")}</th>
          </tr>
        </thead>
        <tbody>
          {facts.map((fact) => (
            <FactRow key={fact.of} fact={fact} />
          ))}
        </tbody>
      </table>
      <Legend facts={facts} />
    </details>
  );
}

/** What the abbreviations in the sources mean. */
function Legend({ facts }: { facts: readonly Fact[] }) {
  const legend = legendOf(facts.map(({ source }) => source));
  if (legend.length === 0) return null;
  return (
    <dl className="legend" aria-label={t("facts.legend")}>
      {legend.map(({ key, meaning }) => (
        <div key={key}>
          <dt className="mono">{key}</dt>
          <dd>{meaning}</dd>
        </div>
      ))}
    </dl>
  );
}

function FactRow({ fact }: { fact: Fact }) {
  const name = isKnown(fact.of) ? t(`facts.of.${fact.of}`) : fact.of;
  return (
    <tr>
      <th scope="row">{name}</th>
      <td className="mono">{fact.value}</td>
      <td className={fact.verified ? "looked" : "muted"}>
        <Icon name={fact.verified ? "check" : "info"} small />
        {t(fact.verified ? "errors.verified" : "errors.unverified")}
      </td>
      <td className="muted">
        {fact.source || t("facts.nosource")}
        {fact.inherited && fact.source && ` ${t("facts.inherited")}`}
      </td>
    </tr>
  );
}
