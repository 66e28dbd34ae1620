use hopper_proof::*; use std::time::Instant; use basin_of_attraction::*; use std::ops::ControlFlow::Continue;
fn show(t: Theorem, s: Instant){ println!("== {} {} {:.2}s ({} steps)", t.name, if t.is_proved(){"PROVED"}else{"open"}, s.elapsed().as_secs_f64(), t.steps.len()); for st in t.steps.iter().filter(|st| !st.holds).take(6).chain(t.steps.iter().take(3)) { println!("   {} {} :: {}", st.holds, st.claim, st.found);} }
fn main(){
  let a: Vec<String> = std::env::args().skip(1).collect();
  let s=Instant::now();
  match a[0].as_str() {
   "small" => { show(one_sudden(),s); show(one_sided(8).unwrap(),s); show(crises(10).unwrap(),s); show(trap_edges(8,1000).unwrap(),s); show(everything_hops().unwrap(),s); }
   "rising" => { let n=a[1].parse().unwrap(); let m=a[2].parse().unwrap(); show(rising(&[(n,m)]).unwrap(),s); }
   "measures" => { show(measures(&[(a[1].parse().unwrap(),a[2].parse().unwrap())]).unwrap(),s); }
   "points" => { let n: usize=a[1].parse().unwrap(); let y=hopper_basin::first_humps(5); let grid=Grid{x:Interval{left:0.02,right:1.0},y,columns:n,rows:1024}; let im=proved_points(grid,|_|Continue(())).unwrap(); let open=im.labels.iter().filter(|l| !(l.is_basin()|| **l==hopper_basin::HopperFate::GROUNDED)).count(); println!("points {n}x1024 open {open} of {} in {:.1}s", im.labels.len(), s.elapsed().as_secs_f64());
     let im2=hopper_basin::basin_raster(grid,|_|Continue(())).unwrap(); let wrong=im.labels.iter().zip(&im2.labels).filter(|(a,b)| a!=b).count(); println!("different {wrong}"); }
   "cells" => { let n: usize=a[1].parse().unwrap(); let k: usize=a[2].parse().unwrap(); let (x,y)= if a.len()>3 {(Interval{left:0.17,right:0.18},Interval{left:17.0,right:17.8})} else {(Interval{left:0.02,right:1.0},hopper_basin::first_humps(5))}; 
      // every n-th column of 1024
      let mut open=(0.0,0.0,0.0); let mut c=0.0; let w=x.length()/1024.0;
      for at in (n/2..1024).step_by(n) { let g=Grid{x:Interval{left:x.left+w*at as f64,right:x.left+w*(at+1) as f64},y,columns:1,rows:1024}; let s=Instant::now(); let p=ProvedCells::new(g,k,|_|Continue(())).unwrap(); println!("M {:.4} undecided {:.4} open cells {:.4} open area {:.4} {:.2}s", g.x.left,p.undecided_cells(),p.open_cells(),p.open_area(),s.elapsed().as_secs_f64()); open.0+=p.undecided_cells(); open.1+=p.open_cells(); open.2+=p.open_area(); c+=1.0; }
      println!("mean undecided {:.4} open {:.4} area {:.4} total {:.1}s for {c}", open.0/c, open.1/c, open.2/c, s.elapsed().as_secs_f64()); }
   _ => {} }
}
