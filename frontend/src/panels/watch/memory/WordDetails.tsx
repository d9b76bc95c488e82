import { useEffect, useRef, useState } from "react";
import { inAll, type WholeArea } from "../../../logic/watch/memory";
import { showWriter } from "../../../store/past/writer";
import { useBench } from "../../../store/plc/bench";
import { follow } from "../../../store/plc/follow";
import { sortKey } from "../../../store/plc/values";
import { useForces } from "../../../store/watch/forces";
import { useMemory, wordIn } from "../../../store/watch/memory";
import { addToWatch } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { MemoryWord, PlcSymbol } from "../../../wire/types";

/** The selected word: its value in every format, and the variables that lie in it. */
export function WordDetails({ area }: { area: WholeArea }) {
  const selected = useMemory((memory) => memory.selected);
  const word = useMemory(({ blocks }) => wordIn(blocks, area.name, selected));
  if (!word || selected >= area.words) return null;
  return <Details key={word.address} word={word} area={area.name} />;
}

function Details({ word: { address, symbols }, area }: { word: MemoryWord; area: string }) {
  const readOnly = useReadOnly(area);
  const forced = useForces(({ held }) =>
    [...held.values()].find(
      ({ path }) => path === address || path.startsWith(`${address}.`) || symbols.some((each) => each.path === path),
    ),
  );
  return (
    <section className="memword" aria-label={t("memory.word", { address })}>
      <div className="memhead">
        <h3 className="mono">{address}</h3>
        {forced && (
          <span className="st forced">
            <Icon name="forced" small />
            {`${forced.path}: ${t("force.to", { value: forced.value })}`}
          </span>
        )}
        {readOnly && <span className="faint">{t("memory.readonly")}</span>}
        <span className="grow" />
        <button type="button" className="btn quiet sm" onClick={() => showWriter(address)}>
          {t("writer.menu")}
        </button>
        <button type="button" className="btn quiet sm" onClick={() => addToWatch([address])}>
          {t("watch.addone")}
        </button>
      </div>
      <Values address={address} />
      <ul className="memvars" aria-label={t("memory.variables")}>
        {symbols.map((symbol) => (
          <Variable key={symbol.path} symbol={symbol} />
        ))}
        {symbols.length === 0 && <li className="faint">{t("memory.variables.none")}</li>}
      </ul>
    </section>
  );
}

/** Whether tools may not write the word; the model says it for each part of an area. */
function useReadOnly(area: string): boolean {
  const selected = useMemory((memory) => memory.selected);
  const model = useBench((bench) => bench.model);
  let before = 0;
  for (const part of model?.areas ?? []) {
    if (part.name !== area) continue;
    if (selected < before + part.words) return part.tool !== "write";
    before += part.words;
  }
  return false;
}

function Values({ address }: { address: string }) {
  const [value, setValue] = useState<bigint | null>(null);
  useEffect(
    // The grid watches only what is visible, and the selected word may not be.
    () =>
      follow(address, "hex", () => {
        const key = sortKey(address);
        setValue(key === null || typeof key === "string" ? null : BigInt(key));
      }),
    [address],
  );
  if (value === null) return null;
  return (
    <dl className="memvalues">
      {inAll(value).map(({ format, text }) => (
        <div key={format}>
          <dt>{t(`format.${format as "hex"}`)}</dt>
          <dd className="mono">{text}</dd>
        </div>
      ))}
    </dl>
  );
}

function Variable({ symbol: { path, type, address } }: { symbol: PlcSymbol }) {
  const text = useRef<HTMLSpanElement>(null);
  useEffect(
    () =>
      follow(path, "default", (reading) => {
        if (text.current) text.current.textContent = reading.text;
      }),
    [path],
  );
  return (
    <li>
      <span className="mono">{path}</span>
      <span className="faint">{address && `${type} · ${address}`}</span>
      <span ref={text} className="mono" />
      <button
        type="button"
        className="link"
        aria-label={t("watch.add.path", { path })}
        onClick={() => addToWatch([path])}
      >
        {t("watch.addone")}
      </button>
    </li>
  );
}
