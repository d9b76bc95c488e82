import { memo } from "react";
import { type DiagramInput, type DiagramItem, type DiagramOutput, NOTHING } from "../../../../logic/graphic/diagram";
import {
  type DiagramDrawing,
  type DiagramDrawn,
  type DiagramPinDrawn,
  STUB,
  shortPin,
} from "../../../../logic/graphic/diagramLayout";
import { type PinSpot, pinsOf } from "../../../../logic/graphic/diagramPins";
import { isVariable } from "../../../../logic/graphic/measure";
import { t } from "../../../../text";
import { nameOfItem, nameOfPin } from "./names";
import { apartAt, isChosen, type Marked, SpotGroup, sharp, wrongAt } from "./SpotGroup";

interface Props extends Marked {
  drawing: DiagramDrawing;
}

/** A function block diagram as it is drawn. Values are written to its wires and texts directly: see `liveDiagram.ts`. */
export const DiagramPicture = memo(function DiagramPicture({ drawing, ...marked }: Props) {
  const { width, height, elements, wires } = drawing;
  return (
    <svg className="draw" width={width} height={height} role="presentation">
      {wires.map(({ wire, points }, index) => (
        <path
          // biome-ignore lint/suspicious/noArrayIndexKey: a wire is nothing but its place in the drawing
          key={index}
          className="wire"
          data-wire={wire}
          data-apart={apartAt(marked.apart, wire)}
          d={`M${points.map(([x, y]) => `${sharp(x)} ${sharp(y)}`).join("L")}`}
        />
      ))}
      {elements.map((drawn) => (
        <Element key={drawn.order} drawn={drawn} {...marked} />
      ))}
      {pinsOf(drawing).map((pin) => (
        <Pin key={pin.place.join(".")} pin={pin} {...marked} />
      ))}
    </svg>
  );
});

/** Where a pin is selected: what is drawn there belongs to its item. */
function Pin({ pin, id, cursor, chosen, wrong: all }: { pin: PinSpot } & Marked) {
  const key = pin.place.join(".");
  const wrong = wrongAt(all, key);
  return (
    <g
      id={`${id}-${key}`}
      role="option"
      aria-selected={chosen === "" ? key === cursor : isChosen(chosen, key)}
      aria-label={[nameOfPin(pin), wrong].filter(Boolean).join(", ")}
      data-element={key}
      data-side={pin.side}
      data-wrong={wrong === "" ? undefined : ""}
    >
      {wrong !== "" && <title>{wrong}</title>}
      <rect className="hit" x={pin.x} y={pin.y - 9} width={pin.width - 2} height={18} rx={3} />
    </g>
  );
}

function Element({ drawn, ...marked }: { drawn: DiagramDrawn } & Marked) {
  const { element, x, y, width, up, down, place } = drawn;
  return (
    <SpotGroup
      {...marked}
      place={place}
      kind="item"
      name={nameOfItem(element.item, drawn.order)}
      box={{ x: x - 3, y: y - up - 3, width: width + 6, height: up + down + 6 }}
      dot={{ x, y: y - up }}
    >
      <Body drawn={drawn} item={element.item} />
      {drawn.inputs.map((input) => (
        <Input key={input.y} input={input} x={x} boxed={element.kind === "box"} />
      ))}
      {drawn.outputs.map((output) => (
        <Output key={output.y} output={output} x={x + width} boxed={element.kind === "box"} />
      ))}
    </SpotGroup>
  );
}

function Body({ drawn: { x, y, width, up, down, order }, item }: { drawn: DiagramDrawn; item: DiagramItem }) {
  if (item.kind === "value") {
    const [pin] = item.inputs;
    const same = pin && !pin.negated && pin.edge === "" ? pin : undefined;
    const wire = same?.wire ?? undefined;
    return (
      <path
        className="wire"
        data-wire={wire}
        data-pin={wire ? undefined : same?.text}
        d={`M${x} ${sharp(y)}h${width}`}
      />
    );
  }
  if (item.kind === "leave")
    return (
      <>
        <path className="sym round" d={`M${x + 4} ${y - 5}l6 5.5-6 5.5`} />
        <text className="nm l" x={x + 16} y={y + 4}>
          {item.label === "" ? t("graphic.return") : item.label}
        </text>
      </>
    );
  return (
    <>
      <rect className="boxr" x={sharp(x)} y={sharp(y - up)} width={width - 1} height={up + down - 1} />
      <text className="ty" x={x + width / 2} y={y - up + 16}>
        {item.callee}
      </text>
      <text className="ord" x={x + width - 4} y={y - up + 10}>
        {order}
      </text>
    </>
  );
}

/** What comes in: a wire, the stub of one that is set below, or a text. A negated pin has a ring, one for an edge a mark. */
function Input({
  input: { pin, y, from },
  x,
  boxed,
}: {
  input: DiagramPinDrawn<DiagramInput>;
  x: number;
  boxed: boolean;
}) {
  const end = x - (pin.negated ? 7 : 0);
  return (
    <g className={from === "nothing" ? "bad" : undefined}>
      {boxed && (
        <text className="pn" x={x + 8} y={y + 4}>
          {pin.name}
        </text>
      )}
      {from !== "wire" && (
        <path
          className={`wire${from === "loop" ? " back" : ""}`}
          data-pin={from === "text" ? pin.text : undefined}
          data-wire={from === "loop" ? (pin.wire ?? undefined) : undefined}
          d={`M${x - (from === "loop" ? 34 : STUB)} ${sharp(y)}H${end}`}
        />
      )}
      {from === "text" && <Padlock x={x - STUB} y={y} />}
      {from !== "wire" && <Text text={pin.text} x={x - (from === "loop" ? 38 : STUB + 4)} y={y} side="r" />}
      {from === "nothing" && (
        <title>{pin.text === NOTHING ? t("graphic.nothing") : t("graphic.unconnected", { wire: pin.text })}</title>
      )}
      {pin.negated && <circle className="ring round" cx={x - 3.5} cy={y + 0.5} r={3.5} />}
      {pin.edge !== "" && (
        <path
          className="sym round"
          d={pin.edge === "P" ? `M${x + 0.5} ${y - 4}l5 4.5-5 4.5` : `M${x + 6} ${y - 4}l-5 4.5 5 4.5`}
        />
      )}
    </g>
  );
}

function Output({
  output: { pin, y },
  x,
  boxed,
}: {
  output: DiagramPinDrawn<DiagramOutput>;
  x: number;
  boxed: boolean;
}) {
  const marked = pin.operator === "" ? 0 : 20;
  return (
    <g>
      {boxed && (
        <text className="pn r" x={x - 7} y={y + 4}>
          {pin.name}
        </text>
      )}
      {pin.wire === null ? (
        <>
          <path className="wire" data-pin={pin.target} d={`M${x} ${sharp(y)}h${STUB}`} />
          {pin.operator !== "" && (
            <>
              <rect className="boxr" x={sharp(x + STUB)} y={sharp(y - 8)} width={16} height={16} />
              <text className="mod" x={x + STUB + 8.5} y={y + 4.5}>
                {pin.operator}
              </text>
            </>
          )}
          <Padlock x={x + 3} y={y} />
          <Text text={pin.target} x={x + STUB + 4 + marked} y={y} side="l" />
        </>
      ) : (
        <text className="cap l" x={x + 6} y={y - 4}>
          {pin.target}
          <tspan className="vl" data-wirevalue={pin.wire} dx={5} />
        </text>
      )}
      {pin.negated && <circle className="ring round" cx={x + 3.5} cy={y + 0.5} r={3.5} />}
    </g>
  );
}

/** There while the variable of a pin is forced. */
const Padlock = ({ x, y }: { x: number; y: number }) => (
  <path
    className="pad round"
    transform={`translate(${x},${y - 13})`}
    d="M1.5 5.5h7v4.5h-7zM3 5.5V3.7a2 2 0 0 1 4 0v1.8"
  />
);

/** A variable with its value, or a literal or an expression. */
function Text({ text, x, y, side }: { text: string; x: number; y: number; side: "l" | "r" }) {
  const short = shortPin(text);
  const live = isVariable(text);
  return (
    <text className={`nm ${side}${live || text.startsWith("#") ? "" : " lit"}`} x={x} y={y + 4}>
      {short !== text && <title>{text}</title>}
      {short}
      {live && <tspan className="vl" data-value={text} />}
    </text>
  );
}
