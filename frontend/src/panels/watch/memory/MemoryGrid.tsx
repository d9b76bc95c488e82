import { type KeyboardEvent, memo, useCallback, useEffect, useMemo, useRef, useState } from "react";
import { literalOf } from "../../../logic/format/formats";
import { columnsOf, type MemoryFormat, movedTo, type WholeArea, WORD } from "../../../logic/watch/memory";
import { useWidths } from "../../../store/page/columns";
import { useForbidden } from "../../../store/plc/plc";
import { currentText, sortKey } from "../../../store/plc/values";
import { useWatches, watch } from "../../../store/plc/watches";
import { complain, loadWords, selectWord, useMemory, wordIn, writeWord } from "../../../store/watch/memory";
import { t } from "../../../text";
import { useColumns } from "../../../ui/useColumns";
import { useGrid, useReveal } from "../../../ui/useGrid";
import type { MemoryWord } from "../../../wire/types";
import { showLive } from "../live";

/** The words: only the visible rows are in the page, and are watched. The grid has the focus, the selected word is its active descendant. */
export function MemoryGrid({ area }: { area: WholeArea }) {
  const { format, selected, blocks } = useMemory();
  const forbidden = useForbidden("write");
  const [typed, setTyped] = useState<{ index: number; first: string } | null>(null);
  const wordAt = useCallback((index: number) => wordIn(blocks, area.name, index), [blocks, area.name]);
  const columns = columnsOf([wordAt(0)?.address, wordAt(10)?.address], format);
  const grid = useGrid({ count: Math.ceil(area.words / columns) });
  const { style, grip, head } = useColumns(useWidths(format === "binary" ? "memory.binary" : "memory"));
  const [from, to] = [grid.from * columns, Math.min(grid.to * columns, area.words)];
  useReveal(Math.floor(selected / columns), `${selected} ${columns}`, grid.reveal);
  useWords(area.name, from, to, wordAt);

  function edit(first: string): void {
    if (forbidden !== null) complain(forbidden);
    else if (wordAt(selected)) setTyped({ index: selected, first });
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if (event.target instanceof HTMLInputElement) return;
    const page = grid.to - grid.from - 2;
    const next = movedTo(event.key, event.ctrlKey, selected, area.words, columns, Math.max(page, 1));
    if (next !== undefined) selectWord(next);
    else if (event.key === "Enter" || event.key === "F2") edit(textOf(wordAt(selected), format));
    else if (event.key.length === 1 && !event.ctrlKey && !event.metaKey && !event.altKey && event.key !== "?")
      edit(event.key);
    else return;
    event.preventDefault();
  }

  /** What is refused stays in its field. */
  async function enter({ address }: MemoryWord, value: string): Promise<void> {
    if (!(await writeWord(address, literalOf(WORD, format, value)))) return;
    setTyped(null);
    grid.scroll.current?.focus();
  }

  const heads = Array.from({ length: columns }, (_, at) => `+${at}`);
  return (
    <div
      ref={grid.scroll}
      className={`grid memgrid scroll of-${format}`}
      role="grid"
      aria-label={t("memory.of", { area: area.name })}
      aria-rowcount={Math.ceil(area.words / columns) + 1}
      aria-colcount={columns + 1}
      aria-activedescendant={
        grid.isDrawn(Math.floor(selected / columns)) && wordAt(selected) ? cellId(selected) : undefined
      }
      style={{ ...style, "--n": columns } as React.CSSProperties}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className="gr h" role="row">
        {head("address", t("memory.address"))}
        {heads.map((name) => (
          <span key={name} className="num" role="columnheader" aria-label={name}>
            {name}
            {grip("word", name)}
          </span>
        ))}
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const first = item.index * columns;
          return (
            <div
              key={item.key}
              className="gr"
              role="row"
              aria-rowindex={item.index + 2}
              style={{ transform: `translateY(${grid.topOf(item)}px)` }}
            >
              <span className="mono faint" role="rowheader">
                {wordAt(first)?.address ?? "…"}
              </span>
              {heads.map((head, at) => {
                const index = first + at;
                const word = wordAt(index);
                if (index >= area.words || !word) return <span key={head} role="gridcell" />;
                if (index === typed?.index)
                  return (
                    <Entry
                      key={head}
                      id={cellId(index)}
                      word={word}
                      first={typed.first}
                      onEnter={(value) => void enter(word, value)}
                      onLeave={() => setTyped(null)}
                    />
                  );
                return (
                  <WordCell
                    key={head}
                    index={index}
                    word={word}
                    format={format}
                    on={index === selected}
                    onEdit={edit}
                  />
                );
              })}
            </div>
          );
        })}
      </div>
    </div>
  );
}

const cellId = (index: number) => `memory-${index}`;

const textOf = (word: MemoryWord | undefined, format: MemoryFormat) =>
  word ? bare(currentText(word.address, format), format) : "";

/** The format is said once, above the grid: 16#00FF is 00FF here. */
const bare = (text: string, format: MemoryFormat) =>
  format === "ascii" ? text.slice(1, -1) : format === "bcd" ? text : text.replace(/^\d+#/, "");

/** Asks for the names of what is visible, and watches it. */
function useWords(area: string, from: number, to: number, wordAt: (index: number) => MemoryWord | undefined): void {
  // biome-ignore lint/correctness/useExhaustiveDependencies: asks again once the names were forgotten
  useEffect(() => {
    if (to > from) void loadWords(area, from, to);
    void loadWords(area, 0, 1); // the first block says how the area counts
  }, [area, from, to, wordAt]);
  const paths = useMemo(() => {
    const shown = Array.from({ length: Math.max(0, to - from) }, (_, at) => wordAt(from + at)?.address);
    return shown.filter((path) => path !== undefined);
  }, [from, to, wordAt]);
  useEffect(() => watch(paths), [paths]);
}

interface CellProps {
  index: number;
  word: MemoryWord;
  format: MemoryFormat;
  on: boolean;
  onEdit: (first: string) => void;
}

const WordCell = memo(function WordCell({ index, word: { address, symbols }, format, on, onEdit }: CellProps) {
  const cell = useRef<HTMLSpanElement>(null);
  const text = useRef<HTMLSpanElement>(null);
  const known = useWatches(({ symbols: all }) => all.has(address));
  // biome-ignore lint/correctness/useExhaustiveDependencies: reads the cell again when the symbol arrives
  useEffect(() => {
    if (!cell.current || !text.current) return;
    const { current: whole } = cell;
    const written = (shown: string) => {
      const short = bare(shown, format);
      whole.classList.toggle("zero", Number(sortKey(address) ?? -1) === 0);
      return format === "binary" ? short.replace(/\B(?=(.{4})+$)/g, " ") : short;
    };
    return showLive(address, format, { cell: whole, text: text.current, written });
  }, [address, format, known]);
  const names = symbols.map(({ path }) => path).join(", ");
  return (
    <span
      ref={cell}
      id={cellId(index)}
      className={`val${on ? " on" : ""}${names ? " named" : ""}`}
      role="gridcell"
      aria-selected={on}
      title={names ? `${address}: ${names}` : address}
      data-testid={`memory:${address}`}
      onClick={() => selectWord(index)}
      onDoubleClick={() => onEdit(bare(currentText(address, format), format))}
    >
      <span className="sr">{names ? `${address}, ${names}: ` : `${address}: `}</span>
      <span ref={text} className="txt" />
    </span>
  );
});

interface EntryProps {
  id: string;
  word: MemoryWord;
  first: string;
  onEnter: (value: string) => void;
  onLeave: () => void;
}

/** The field in which the selected word is typed: Enter writes, Escape leaves it as it is. */
function Entry({ id, word: { address }, first, onEnter, onLeave }: EntryProps) {
  const input = useRef<HTMLInputElement>(null);
  const [value, setValue] = useState(first);
  useEffect(() => {
    input.current?.focus();
    if (first.length > 1) input.current?.select();
  }, [first]);
  return (
    <span id={id} role="gridcell" className="memedit">
      <input
        ref={input}
        className="inp sm mono"
        aria-label={t("memory.change", { address })}
        value={value}
        onChange={({ target }) => setValue(target.value)}
        onBlur={onLeave}
        onKeyDown={(event) => {
          if (event.key === "Enter") onEnter(value);
          else if (event.key === "Escape") {
            event.currentTarget.closest<HTMLElement>("[role=grid]")?.focus();
            onLeave();
          } else return;
          event.preventDefault();
          event.stopPropagation();
        }}
      />
    </span>
  );
}
