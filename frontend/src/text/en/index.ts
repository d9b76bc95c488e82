/** English, all of it. */
import { commands } from "./commands";
import { common } from "./common";
import { communication } from "./communication";
import { debug } from "./debug";
import { disturb } from "./disturb";
import { errors } from "./errors";
import { graphic } from "./graphic";
import { hardware } from "./hardware";
import { operator } from "./operator";
import { past } from "./past";
import { plc } from "./plc";
import { project } from "./project";
import { sweep } from "./sweep";
import { together } from "./together";
import { tour } from "./tour";
import { trace } from "./trace";
import { userErrors } from "./userErrors";
import { verify } from "./verify";
import { watch } from "./watch";

export const english = {
  ...commands,
  ...common,
  ...plc,
  ...project,
  ...watch,
  ...errors,
  ...graphic,
  ...hardware,
  ...sweep,
  ...userErrors,
  ...communication,
  ...debug,
  ...together,
  ...trace,
  ...tour,
  ...verify,
  ...disturb,
  ...past,
  ...operator,
};

export type TextKey = keyof typeof english;
