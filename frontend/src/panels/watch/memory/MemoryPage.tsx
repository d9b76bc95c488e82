/** The memory of the PLC, area by area: every word live, with the variables that lie in it; to look around, to write, to find a value. */
import { useEffect, useMemo, useState } from "react";
import { FIND_BITS, type FindBits, MEMORY_FORMATS, type WholeArea, wholeAreas } from "../../../logic/watch/memory";
import { useBench } from "../../../store/plc/bench";
import { complete } from "../../../store/plc/completion";
import { usePlc } from "../../../store/plc/plc";
import {
  fallBackTo,
  findValue,
  forgetNames,
  goToAddress,
  showArea,
  showFormat,
  useMemory,
} from "../../../store/watch/memory";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";
import { PathField } from "../../../ui/PathField";
import "./memory.css";
import { MemoryGrid } from "./MemoryGrid";
import { WordDetails } from "./WordDetails";

export function MemoryPage() {
  const model = useBench((bench) => bench.model);
  const instance = useBench((bench) => bench.instance?.id);
  const version = usePlc((plc) => plc.state?.program_version);
  const wanted = useMemory((memory) => memory.area);
  const areas = useMemo(() => wholeAreas(model?.areas ?? []), [model]);
  const area = areas.find(({ name }) => name === wanted) ?? areas[0];
  const name = area?.name;
  // What was looked at on a different model may not be there.
  useEffect(() => {
    if (name !== undefined && name !== wanted) fallBackTo(name);
  }, [name, wanted]);
  const away = usePlc(
    ({ link, state }) => link.state !== "open" || ["off", "silent", "failed"].includes(state?.state ?? "off"),
  );
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different program may have other variables there; one that was away is asked again
  useEffect(() => {
    if (!away) forgetNames();
  }, [version, away]);

  return (
    <section className="pane flexcol memory" aria-label={t("memory.title")} data-pane="memory" data-live>
      {instance === undefined || !area ? (
        <Empty title={t("memory.empty")} about={t("memory.empty.about")} ways={[]} />
      ) : (
        <>
          <Toolbar area={area} areas={areas} />
          <MemoryGrid key={`${instance} ${area.name}`} area={area} />
          <Notes />
          <WordDetails area={area} />
        </>
      )}
    </section>
  );
}

function Toolbar({ area, areas }: { area: WholeArea; areas: readonly WholeArea[] }) {
  const format = useMemory((memory) => memory.format);
  return (
    <div className="sub tall membar">
      <select
        className="inp sm"
        aria-label={t("memory.area")}
        value={area.name}
        onChange={({ target }) => showArea(target.value)}
      >
        {areas.map(({ name, first, last, description }) => (
          <option key={name} value={name}>
            {`${name}  ${first}–${last}${description ? `  ${description}` : ""}`}
          </option>
        ))}
      </select>
      <select
        className="inp sm"
        aria-label={t("memory.format")}
        value={format}
        onChange={({ target }) => {
          const chosen = MEMORY_FORMATS.find((known) => known === target.value);
          if (chosen) showFormat(chosen);
        }}
      >
        {MEMORY_FORMATS.map((name) => (
          <option key={name} value={name}>
            {t(`format.${name}`)}
          </option>
        ))}
      </select>
      <GoTo />
      <Find area={area.name} />
    </div>
  );
}

function GoTo() {
  const [path, setPath] = useState("");
  return (
    <form
      className="memgo"
      onSubmit={(event) => {
        event.preventDefault();
        event.currentTarget.closest("section")?.querySelector<HTMLElement>("[role=grid]")?.focus();
        void goToAddress(path);
      }}
    >
      <PathField
        label={t("memory.goto")}
        placeholder={t("memory.goto")}
        value={path}
        onChange={setPath}
        complete={complete}
      />
    </form>
  );
}

function Find({ area }: { area: string }) {
  const [text, setText] = useState("");
  const [bits, setBits] = useState<FindBits>(16);
  return (
    <form
      className="memfind"
      onSubmit={(event) => {
        event.preventDefault();
        if (text.trim() !== "") void findValue(area, text, bits);
      }}
    >
      <input
        className="inp sm mono"
        aria-label={t("memory.find")}
        placeholder={t("memory.find")}
        value={text}
        onChange={({ target }) => setText(target.value)}
      />
      <select
        className="inp sm"
        aria-label={t("memory.bits")}
        value={bits}
        onChange={({ target }) => setBits(FIND_BITS.find((known) => known === Number(target.value)) ?? 16)}
      >
        {FIND_BITS.map((width) => (
          <option key={width} value={width}>
            {t("memory.bits.of", { bits: width })}
          </option>
        ))}
      </select>
      <button type="submit" className="btn sm" disabled={text.trim() === ""}>
        {t("memory.find.next")}
      </button>
    </form>
  );
}

/** What was found, or why something could not be done. */
function Notes() {
  const { trouble, found } = useMemory();
  if (trouble !== null)
    return (
      <p className="memnote st fatal" role="alert">
        <Icon name="error" small />
        <span>{trouble}</span>
      </p>
    );
  if (found === null) return null;
  return (
    <p className="memnote muted" role="status">
      {found}
    </p>
  );
}
