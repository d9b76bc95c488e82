/** Makes room between two lines of an editor for an element of the page, which moves and scrolls with the text. */
import type { editor } from "./monaco";

export interface Zone {
  element: HTMLElement;
  dispose: () => void;
}

/** As `lineHeight` in the editor's options. */
const LINE = 20;

let next = 0;

/**
 * Opens below a line and is as high as its content. Monaco's zones are below its text and get no mouse events: the zone only
 * makes room, the element lies above it.
 */
export function openZone(code: editor.IStandaloneCodeEditor, line: number): Zone {
  next += 1;
  const name = `scanbench.zone.${next}`;
  const element = document.createElement("div");
  element.className = "linezone";
  const room = document.createElement("div");
  let top = 0;
  const zone: editor.IViewZone = {
    afterLineNumber: line,
    heightInPx: 40,
    domNode: room,
    onDomNodeTop: (now) => {
      top = now;
      element.style.top = `${top}px`;
    },
  };
  const widget: editor.IOverlayWidget = { getId: () => name, getDomNode: () => element, getPosition: () => null };
  code.addOverlayWidget(widget);
  let id = "";
  code.changeViewZones((zones) => {
    id = zones.addZone(zone);
  });
  const toWidth = () => {
    const { contentLeft, contentWidth, verticalScrollbarWidth } = code.getLayoutInfo();
    element.style.left = `${contentLeft}px`;
    element.style.width = `${contentWidth - verticalScrollbarWidth}px`;
  };
  toWidth();
  const layout = code.onDidLayoutChange(toWidth);
  const sized = new ResizeObserver(() => {
    if (zone.heightInPx === element.offsetHeight) return;
    zone.heightInPx = element.offsetHeight;
    code.changeViewZones((zones) => zones.layoutZone(id));
    const bottom = code.getTopForLineNumber(line) + LINE + element.offsetHeight;
    const { height } = code.getLayoutInfo();
    if (bottom > code.getScrollTop() + height) code.setScrollTop(bottom - height);
  });
  sized.observe(element);
  return {
    element,
    dispose: () => {
      sized.disconnect();
      layout.dispose();
      code.changeViewZones((zones) => zones.removeZone(id));
      code.removeOverlayWidget(widget);
    },
  };
}
