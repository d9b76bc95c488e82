import { memo } from "react";
import type { ChartAction, ChartStep, ChartTransition } from "../../../../logic/graphic/chart";
import {
  ACTION_ROW,
  type ChartDrawing,
  type ChartDrawn,
  qualifierText,
  shortened,
} from "../../../../logic/graphic/chartLayout";
import { widthOf } from "../../../../logic/graphic/measure";
import { nameOfChartElement } from "./names";
import { type Marked, SpotGroup, sharp } from "./SpotGroup";

interface Props extends Marked {
  drawing: ChartDrawing;
}

const BAR = 16;

/** A chart as it is drawn. What is active is written to its elements directly: see `liveChart.ts`. */
export const ChartPicture = memo(function ChartPicture({ drawing, ...marked }: Props) {
  const { width, height, elements, lines, arrows } = drawing;
  return (
    <svg className="draw" width={width} height={height} role="presentation">
      {lines.map(({ points, double }, index) => (
        <path
          // biome-ignore lint/suspicious/noArrayIndexKey: a line is nothing but its place in the drawing
          key={index}
          className="wire"
          d={(double ? [-2, 2] : [0])
            .map((by) => `M${points.map(([x, y]) => `${sharp(x)} ${sharp(y + by)}`).join("L")}`)
            .join("")}
        />
      ))}
      {arrows.map(({ x, y, name, unknown }) => (
        <g key={`${x} ${y}`} className={`jump${unknown ? " bad" : ""}`} data-goal={unknown ? undefined : name}>
          <rect className="hit" x={x - 8} y={y - 12} width={widthOf(name) + 26} height={18} />
          <path className="tip round" d={`M${x - 4.5} ${y - 6}h10l-5 7z`} />
          <text className="nm l" x={x + 12} y={y}>
            {name}
          </text>
        </g>
      ))}
      {elements.map((drawn) => (
        <Element key={drawn.place.join(".")} drawn={drawn} {...marked} />
      ))}
    </svg>
  );
});

function Element({ drawn, ...marked }: { drawn: ChartDrawn } & Marked) {
  const { element, x, y, width, up, down, place } = drawn;
  const out = element.kind === "action" ? 1 : 3;
  return (
    <SpotGroup
      {...marked}
      place={place}
      kind={element.kind}
      name={nameOfChartElement(element)}
      box={{ x: x - out, y: y - up - out, width: width + 2 * out, height: up + down + 2 * out }}
      dot={element.kind === "transition" ? { x: drawn.axis, y } : { x, y: y - up }}
    >
      {element.kind === "step" && <Step drawn={drawn} step={element} />}
      {element.kind === "transition" && <Transition drawn={drawn} transition={element} />}
      {element.kind === "action" && <Action drawn={drawn} action={element} />}
    </SpotGroup>
  );
}

/** The name is above the time, which is there while the step is active. */
function Step({ drawn: { x, y, width, up, down }, step }: { drawn: ChartDrawn; step: ChartStep }) {
  const box = { x: sharp(x), y: sharp(y - up), width: width - 1, height: up + down - 1 };
  return (
    <>
      <rect className="boxr" {...box} />
      {step.initial && (
        <rect className="boxr inner" x={box.x + 3} y={box.y + 3} width={box.width - 6} height={box.height - 6} />
      )}
      <rect className="square" x={x + 9} y={y - 4} width={8} height={8} />
      <text className="st" x={x + width / 2} y={y + 4}>
        {step.name}
      </text>
      <text className="time" data-live="time" x={x + width / 2} y={y + 14} />
    </>
  );
}

function Transition({ drawn, transition }: { drawn: ChartDrawn; transition: ChartTransition }) {
  const { axis, y, order } = drawn;
  const text = shortened(transition.condition);
  const at = axis + BAR + 10;
  const named = transition.name === "" ? 0 : widthOf(transition.name) + 12;
  return (
    <>
      {text !== transition.condition && <title>{transition.condition}</title>}
      <path className="tr" d={`M${axis - BAR + 0.5} ${sharp(y)}h${2 * BAR}`} />
      {order !== null && (
        <text className="ord r" x={axis - BAR - 6} y={y + 4}>
          {order}
        </text>
      )}
      {named > 0 && (
        <text className="pn" x={at} y={y + 4}>
          {transition.name}
        </text>
      )}
      <text className="nm l" x={at + named} y={y + 4}>
        {text}
      </text>
      <text className="vl" data-live="values" x={at + named + widthOf(text) + 14} y={y + 4} />
    </>
  );
}

function Action({ drawn: { x, y, width, cell }, action }: { drawn: ChartDrawn; action: ChartAction }) {
  const top = sharp(y - ACTION_ROW / 2);
  return (
    <>
      <rect className="boxr cell" x={sharp(x)} y={top} width={cell} height={ACTION_ROW} />
      <rect className="boxr" x={sharp(x + cell)} y={top} width={width - cell - 1} height={ACTION_ROW} />
      <text className="pn m" x={x + cell / 2} y={y + 4}>
        {qualifierText(action)}
      </text>
      <path
        className="pad round"
        transform={`translate(${x + cell + 6},${y - 6})`}
        d="M1.5 5.5h7v4.5h-7zM3 5.5V3.7a2 2 0 0 1 4 0v1.8"
      />
      <text className="nm l" x={x + cell + 8} y={y + 4}>
        {action.action}
        {action.indicator !== "" && <tspan className="pn">{` ${action.indicator}`}</tspan>}
      </text>
      <rect className="lamp" x={x + width - 17.5} y={y - 4.5} width={8} height={8} />
    </>
  );
}
