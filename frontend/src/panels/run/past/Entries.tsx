import { inNames } from "../../../logic/errors/catalogue";
import { grouped } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { t } from "../../../text";
import type { BetweenEntry } from "../../../wire/types";

interface Props {
  title: string;
  entries: readonly BetweenEntry[];
  /** The text for an empty list. */
  none?: string;
  /** The names of the runs A and B. */
  names?: Readonly<Record<string, string>>;
  onGo: (scan: number) => void;
}

/** The commands of the runs: scan, author, text. */
export function Entries({ title, entries, none, names = {}, onGo }: Props) {
  const { errors } = useCatalogue();
  if (entries.length === 0) return none === undefined ? null : <p className="hint">{none}</p>;
  return (
    <section className="entered" aria-label={title}>
      <h3>{title}</h3>
      <ul>
        {entries.map(({ scan, run, author, text }, index) => (
          // biome-ignore lint/suspicious/noArrayIndexKey: the same command may be entered twice before one scan
          <li key={`${scan} ${index}`}>
            <button
              type="button"
              className="link mono"
              title={t("changes.goto", { scan: grouped(scan) })}
              onClick={() => onGo(scan)}
            >
              {grouped(scan)}
            </button>
            {run !== "" && <span className="faint cut">{names[run] ?? run}</span>}
            <span className="grow cut" title={text}>
              {inNames(errors, text)}
            </span>
            <span className="faint cut">{author}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}
