import type { ReactNode } from "react";
import { countReaders } from "../../../logic/errors/sweep";
import { grouped } from "../../../logic/format/numbers";
import { baseName } from "../../../logic/format/paths";
import { openFile } from "../../../store/page/navigate";
import { t } from "../../../text";
import type { Reaction } from "../../../wire/types";

/** At most this many of a kind are listed; the rest is given as a number. */
const MOST = 20;

interface Props {
  reaction: Reaction;
  raised: number;
  flag: string;
  codeWord: string;
  code: string;
}

/** A reaction in numbers. */
export function Facts({ reaction, raised, flag, codeWord, code }: Props) {
  const { outputs, hidden } = changesOf(reaction);
  const inLog = countReaders(reaction, "log");
  return (
    <dl className="facts">
      <Fact name={t("sweep.fact.raised")} value={<span className="mono">{grouped(raised)}</span>} />
      <Fact
        name={flag ? t("sweep.fact.flag", { flag }) : t("errors.flag")}
        value={reads(countReaders(reaction, "flag"))}
      />
      {code && (
        <Fact name={t("sweep.fact.code", { word: codeWord, code })} value={reads(countReaders(reaction, "code"))} />
      )}
      <Fact name={t("sweep.fact.detail")} value={reads(countReaders(reaction, "detail"))} />
      {inLog > 0 && <Fact name={t("sweep.fact.log")} value={reads(inLog)} />}
      <Fact name={t("sweep.fact.outputs")} value={outputs.length === 0 ? t("sweep.fact.none") : outputs.length} />
      <Fact name={t("sweep.fact.variables")} value={hidden === 0 ? t("sweep.fact.none") : hidden} />
    </dl>
  );
}

/** Who read the error, what changed, which lines ran only because of it. */
export function Found({ reaction }: { reaction: Reaction }) {
  const { readers, lines } = reaction;
  const { outputs, variables, hidden } = changesOf(reaction);
  return (
    <>
      <List title={t("sweep.list.readers")} items={readers} total={readers.length}>
        {({ file, line, pou, what, scan }) => (
          <>
            <Place file={file} line={line} />
            <span className="faint cut" title={t("sweep.reader", { pou, what: t(`reaction.what.${what}`) })}>
              {t(`reaction.what.${what}`)}
            </span>
            <span className="faint end">{t("sweep.inscan", { scan })}</span>
          </>
        )}
      </List>
      <List title={t("sweep.fact.outputs")} items={outputs} total={outputs.length}>
        {Changed}
      </List>
      <List title={t("sweep.fact.variables")} items={variables} total={hidden}>
        {Changed}
      </List>
      <List title={t("sweep.list.lines")} items={lines} total={lines.length}>
        {({ file, line }) => <Place file={file} line={line} />}
      </List>
    </>
  );
}

function changesOf({ differences, difference_count: count }: Reaction) {
  const outputs = differences.filter(({ output }) => output);
  const variables = differences.filter(({ output }) => !output);
  return { outputs, variables, hidden: count - outputs.length };
}

const reads = (count: number) => t("sweep.reads", { count });

function Fact({ name, value }: { name: string; value: ReactNode }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </div>
  );
}

function Place({ file, line }: { file: string; line: number }) {
  return (
    <button
      type="button"
      className="link mono"
      title={t("sweep.goto", { file, line })}
      onClick={() => openFile(file, line)}
    >
      {`${baseName(file)}:${line}`}
    </button>
  );
}

function Changed({ path, without, value, scan }: Reaction["differences"][number]): ReactNode {
  return (
    <>
      <span className="mono cut" title={path}>
        {path}
      </span>
      <span className="mono end" title={t("sweep.changed.hint", { without, value, scan })}>
        <span className="faint">{without}</span> → {value}
      </span>
    </>
  );
}

interface ListProps<T> {
  title: string;
  items: readonly T[];
  total: number;
  children: (item: T) => ReactNode;
}

function List<T extends object>({ title, items, total, children }: ListProps<T>) {
  if (items.length === 0) return null;
  return (
    <section className="foundlist">
      <h3>{title}</h3>
      <ul>
        {items.slice(0, MOST).map((item) => (
          <li key={JSON.stringify(item)}>{children(item)}</li>
        ))}
      </ul>
      {total > MOST && <p className="hint">{t("sweep.more", { count: total - Math.min(MOST, items.length) })}</p>}
    </section>
  );
}
