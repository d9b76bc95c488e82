import { createRoot } from "react-dom/client";
import { App } from "./app/App";
import { connectStores } from "./app/dispatch";
import { start } from "./store/plc/bench";
import { Boundary } from "./ui/Boundary";
import "./ui/tokens.css";
import "./ui/base.css";
import "./ui/people.css";
import "./ui/controls.css";
import "./ui/floating.css";
import "./ui/grid.css";
import "./app/shell.css";
import "./app/narrow.css";
import "./app/dock.css";
import "./panels/panels.css";
import "./ui/forced.css";

connectStores();
void start();
const root = document.getElementById("root");
if (root) {
  createRoot(root).render(
    <Boundary>
      <App />
    </Boundary>,
  );
}
