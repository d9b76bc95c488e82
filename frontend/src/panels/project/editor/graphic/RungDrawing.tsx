import { memo } from "react";
import type { Drawing, Drawn, Frame } from "../../../../logic/graphic/ladderLayout";
import { isVariable, widthOf } from "../../../../logic/graphic/measure";
import { t } from "../../../../text";
import { nameOf } from "./names";
import { apartAt, type Marked, SpotGroup, sharp } from "./SpotGroup";

interface Props extends Marked {
  drawing: Drawing;
}

/** A rung as it is drawn. Its values are written to the elements directly, twenty times a second: see `live.ts`. */
export const RungDrawing = memo(function RungDrawing({ drawing, ...marked }: Props) {
  const { width, height, wires, elements, gaps, rail } = drawing;
  return (
    <svg className="draw" width={width} height={height} role="presentation">
      {wires.map(({ points, node }, index) => (
        <path
          // biome-ignore lint/suspicious/noArrayIndexKey: a wire is nothing but its place in the drawing
          key={index}
          className="wire"
          data-node={node}
          data-apart={apartAt(marked.apart, node)}
          d={`M${points.map(([x, y]) => `${sharp(x)} ${sharp(y)}`).join("L")}`}
        />
      ))}
      <path className="rail2" data-node={0} d={`M${sharp(rail.left)} ${rail.top}V${rail.bottom}`} />
      <path className="rail2" d={`M${sharp(rail.right)} ${rail.top}V${rail.bottom}`} />
      {elements.map((drawn) => (
        <Element key={drawn.place.join(".")} drawn={drawn} {...marked} />
      ))}
      {gaps.map(({ place, x, y, width: wide }) => (
        <SpotGroup
          key={`gap${place.join(".")}`}
          {...marked}
          place={place}
          kind="gap"
          name={t(place.length % 2 === 0 ? "graphic.gap.empty" : "graphic.gap")}
          box={{ x, y: y - 9, width: wide, height: 19 }}
          dot={{ x, y }}
        >
          {null}
        </SpotGroup>
      ))}
    </svg>
  );
});

function Element({ drawn, ...marked }: { drawn: Drawn } & Marked) {
  const { element, x, y, width, up, down, place, frame } = drawn;
  return (
    <SpotGroup
      {...marked}
      place={place}
      name={nameOf(element)}
      box={{ x: x + 1, y: y - up - 4, width: width - 2, height: up + down + 4 }}
      dot={{ x: x + 6, y: y - (frame ? up : 9) }}
    >
      {element.kind === "box" && frame ? <BoxDrawing frame={frame} /> : <Shape drawn={drawn} />}
    </SpotGroup>
  );
}

function Shape({ drawn: { element, x, y, width } }: { drawn: Drawn }) {
  const middle = Math.round(x + width / 2);
  switch (element.kind) {
    case "contact":
      return (
        <>
          <rect className="closed" x={middle - 4} y={y - 6} width={9} height={13} />
          <path
            className="sym bar"
            d={`M${sharp(middle - 5)} ${y - 10}V${y + 11}M${sharp(middle + 5)} ${y - 10}V${y + 11}`}
          />
          {element.mode === "/" && (
            <path className="slash round" d={`M${middle - 3.5} ${y + 6.5}L${middle + 4.5} ${y - 5.5}`} />
          )}
          {(element.mode === "P" || element.mode === "N") && <Mode text={element.mode} x={middle} y={y} />}
          <Name text={element.operand} x={middle} y={y} />
        </>
      );
    case "coil":
      return (
        <>
          <circle className="closed" cx={middle} cy={y + 0.5} r={7} />
          <path
            className="sym round"
            d={`M${middle - 5} ${y - 8.5}A10.5 10.5 0 0 0 ${middle - 5} ${y + 9.5}M${middle + 5} ${y - 8.5}A10.5 10.5 0 0 1 ${middle + 5} ${y + 9.5}`}
          />
          {element.mode === "/" && (
            <path className="slash round" d={`M${middle - 4} ${y + 6.5}L${middle + 5} ${y - 5.5}`} />
          )}
          {element.mode !== "" && element.mode !== "/" && <Mode text={element.mode} x={middle} y={y} />}
          <Name text={element.operand} x={middle} y={y} />
        </>
      );
    case "send":
    case "jump":
      return (
        <>
          <path className="sym round" d={`M${x + 14} ${y - 5}l6 5.5-6 5.5`} />
          <text className="nm l" x={x + 26} y={y + 4}>
            {element.kind === "jump" ? (element.label ?? "RETURN") : `#${element.name}`}
          </text>
        </>
      );
    case "receive":
      return (
        <>
          <circle className="sym round" cx={middle} cy={y + 0.5} r={4} />
          <text className="nm" x={middle} y={y - 9}>
            {`#${element.name}`}
          </text>
        </>
      );
    default:
      return null;
  }
}

const Mode = ({ text, x, y }: { text: string; x: number; y: number }) => (
  <text className="mod" x={x} y={y + 4.5}>
    {text}
  </text>
);

/** The operand above its symbol; a force has a padlock beside it. */
function Name({ text, x, y }: { text: string; x: number; y: number }) {
  return (
    <>
      <text className="nm" x={x} y={y - 14}>
        {text}
      </text>
      <path
        className="pad round"
        transform={`translate(${x - widthOf(text) / 2 - 15},${y - 24})`}
        d="M1.5 5.5h7v4.5h-7zM3 5.5V3.7a2 2 0 0 1 4 0v1.8"
      />
      <text className="seen" data-seen="" x={x} y={y + 24} />
    </>
  );
}

function BoxDrawing({ frame }: { frame: Frame }) {
  const { type, callee, progress, x, y, width, height, inputs, outputs } = frame;
  return (
    <>
      <rect className="boxr" x={sharp(x)} y={sharp(y)} width={width} height={height} />
      <text className="ty" x={x + width / 2} y={y + 16}>
        {type}
      </text>
      {type !== callee && (
        <text className="nm" x={x + width / 2} y={y - 6}>
          {callee}
        </text>
      )}
      {progress !== "" && (
        <text className="vl m" x={x + width / 2} y={y + height + 13} data-value={progress} data-named="" />
      )}
      {inputs.map((pin) => (
        <g key={`i${pin.y}`}>
          {!pin.power && <path className="wire" d={`M${x - 8} ${sharp(pin.y)}H${x}`} />}
          <text className="pn" x={x + 7} y={pin.y + 4}>
            {pin.name}
          </text>
          <text className="nm r" x={x - 13} y={pin.y + 4}>
            <PinText text={pin.text} />
          </text>
        </g>
      ))}
      {outputs.map((pin) => (
        <g key={`o${pin.y}`}>
          {!pin.power && <path className="wire" d={`M${x + width} ${sharp(pin.y)}h8`} />}
          <text className="pn r" x={x + width - 6} y={pin.y + 4}>
            {pin.name}
          </text>
          <text className="nm l" x={x + width + 13} y={pin.y + 4}>
            <PinText text={pin.text} />
          </text>
        </g>
      ))}
    </>
  );
}

/** A variable with its value, or a literal or an expression. */
const PinText = ({ text }: { text: string }) => (
  <>
    {text}
    {isVariable(text) && <tspan className="vl" data-value={text} />}
  </>
);
