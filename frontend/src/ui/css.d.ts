import "react";

// Rows have their level, and grids their columns, as custom properties.
declare module "react" {
  interface CSSProperties {
    "--lv"?: number;
    "--rows"?: number;
    "--cols"?: string;
    "--states"?: number;
  }
}
